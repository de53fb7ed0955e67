#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <set>

#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/parts/thing_parts.hpp"

// Segments as rectangles of a made depth image.
namespace credo::test {

/// Rectangles before a background 1.5 m away, segment 1, each a segment of its own.
class Schematic {
public:
  Schematic() : depth_m_(200, 150, 1.5F) { segments_.labels = Grid<std::int32_t>(200, 150, 1); }

  /// Columns and rows from first to before last.
  template <typename Depth>
  void add(Pixel first, Pixel last, Depth const& depth_m) {
    ++count_;
    for (int v = first.v; v < last.v; ++v) {
      for (int u = first.u; u < last.u; ++u) {
        segments_.labels[Pixel{u, v}] = count_;
        depth_m_[Pixel{u, v}] = static_cast<float>(depth_m(Pixel{u, v}));
      }
    }
  }

  /// Of what is there already.
  template <typename Depth>
  void add_depth(Pixel first, Pixel last, Depth const& depth_m) {
    for (int v = first.v; v < last.v; ++v) {
      for (int u = first.u; u < last.u; ++u) {
        depth_m_[Pixel{u, v}] = static_cast<float>(depth_m(Pixel{u, v}));
      }
    }
  }

  /// Whether segments 2 and 3 become one.
  [[nodiscard]] bool joins(std::optional<Eigen::Vector3d> const& up) const {
    Segments segments = segments_;
    segments.pixel_counts.assign(static_cast<std::size_t>(count_), 0);
    for (std::int32_t const label : segments.labels) {
      ++segments.pixel_counts[static_cast<std::size_t>(label - 1)];
    }
    Segments const joined = join_parts(segments, depth_m_, {525.0, 525.0, 99.5, 74.5}, up, {});
    std::set<std::int32_t> labels;
    for (std::size_t i = 0; i < joined.labels.size(); ++i) {
      if (segments.labels[i] == 2 || segments.labels[i] == 3) {
        labels.insert(joined.labels[i]);
      }
    }
    return labels.size() == 1;
  }

private:
  Grid<float> depth_m_;
  Segments segments_;
  std::int32_t count_ = 1;
};

inline double front(Pixel) {
  return 1.0;
}
inline double flat_inside(Pixel) {
  return 1.1;
}
/// Deepest in the middle: it bends by 30 quanta to its ends, 40 pixels away.
inline double hollow(double from_middle_px, double deepest_m) {
  double const from_middle = from_middle_px / 40.0;
  return 1.0 / (1.0 / deepest_m + 30.0 * 0.00287 * from_middle * from_middle);
}
inline double hollow_inside(Pixel p) {
  return hollow(p.u - 99.5, 1.12);
}

/// A vessel's front, and what is seen over it.
template <typename Depth>
Schematic vessel(Depth const& inside_m, int front_rows = 30) {
  Schematic picture;
  picture.add({60, 70}, {140, 70 + front_rows}, front);
  picture.add({60, 50}, {140, 70}, inside_m);
  return picture;
}

}  // namespace credo::test
