#include "stages/segments/raised_things.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/runs.hpp"
#include "stages/segments/flat_surface.hpp"

namespace credo {
namespace {

using segments::FlatSurface;

/// Of the surfaces that things lie on, at the reference focal length.
constexpr double kSurface_px = 8000.0;
/// What stands out does so by so many times the noise of a mean of nine pixels.
constexpr double kNoises = 5.0;
/// What is around a thing is the surface, but for this part.
constexpr double kBeside = 0.4;

/// What stands out of the large flat segments of an image.
class Relief {
public:
  Relief(Segments const& segments, Grid<float> const& depth_m, double focal_px,
         SegmentsConfig const& config)
      : segments_(segments),
        depth_m_(depth_m),
        per_px_(1.0 / std::max(depth_m.width(), 1)),
        quantum_per_m_(config.quantum_per_m),
        raised_quanta_(config.raised_quanta),
        surfaces_(segments::flat_surfaces(segments, depth_m, config.quantum_per_m,
                                          kSurface_px * focal_px / 525.0 * focal_px / 525.0)) {}

  /// Of each pixel, by how much of what a thing must stand out it does, as the mean over what is of
  /// its segment among itself and its eight neighbours: 1 or more is a thing's middle. 0 where
  /// there is no flat surface.
  [[nodiscard]] Grid<float> heights() const {
    int const height = depth_m_.height();
    auto const width = static_cast<std::size_t>(depth_m_.width());
    Grid<float> result(depth_m_.width(), height);
    // The rows before the first and behind the last have nothing.
    std::array<RowSums, 3> rows = {RowSums(width), RowSums(width), RowSums(width)};
    for (int v = 0; v <= height; ++v) {
      RowSums& below = rows[static_cast<std::size_t>(v % 3)];
      if (v < height) {
        fill(v, below);
      } else {
        std::ranges::fill(below.surface, 0);
      }
      if (v > 0) {
        average(rows[static_cast<std::size_t>((v + 1) % 3)],
                rows[static_cast<std::size_t>((v + 2) % 3)], below, result.row(v - 1));
      }
    }
    return result;
  }

private:
  /// Of a row: the segment whose flat surface is there, 0 for none, and of each pixel and those
  /// beside it that have the same, how many and their heights together.
  struct RowSums {
    explicit RowSums(std::size_t width) : surface(width), sums(width), counts(width) {}
    std::vector<std::int32_t> surface;
    std::vector<float> sums;
    std::vector<float> counts;
  };

  void fill(int v, RowSums& row) const {
    std::ranges::fill(row.surface, 0);
    std::span<std::int32_t const> const labels = segments_.labels.row(v);
    std::vector<float> heights(labels.size() + 2);
    for (std::size_t begin = 0, end = 0; begin < labels.size(); begin = end) {
      end = run_end(labels, begin);
      auto const& surface = surfaces_[static_cast<std::size_t>(labels[begin])];
      if (!surface) {
        continue;
      }
      std::size_t const n = end - begin;
      heights.front() = 0.0F;
      heights[n + 1] = 0.0F;
      find_heights(*surface, v, begin, std::span(heights).subspan(1, n));
      std::fill_n(row.surface.begin() + static_cast<std::ptrdiff_t>(begin), n, labels[begin]);
      for (std::size_t i = 0; i < n; ++i) {
        row.sums[begin + i] = heights[i] + heights[i + 1] + heights[i + 2];
        row.counts[begin + i] = 3.0F;
      }
      row.counts[begin] -= 1.0F;
      row.counts[end - 1] -= 1.0F;
    }
  }

  /// Of pixels side by side, from column `begin` on.
  void find_heights(FlatSurface const& surface, int v, std::size_t begin,
                    std::span<float> heights) const {
    // Far below or above is no height of a thing that lies there, but of another.
    constexpr float kFar = 4.0F;
    auto const& c = surface.coefficients;
    double const y = segments::across(v, depth_m_.height(), per_px_);
    auto const at_middle = static_cast<float>(c[0] + y * (c[2] + y * c[5]));
    auto const slope = static_cast<float>(c[1] + y * c[4]);
    auto const bend = static_cast<float>(c[3]);
    auto const quanta_m = static_cast<float>(1.0 / quantum_per_m_);
    auto const share =
        static_cast<float>(1.0 / std::max(raised_quanta_, kNoises * surface.rms_quanta / 3.0));
    auto const first =
        static_cast<float>(segments::across(static_cast<int>(begin), depth_m_.width(), per_px_));
    auto const step = static_cast<float>(per_px_);
    float const* const depth_m = depth_m_.row(v).data() + begin;
    auto const n = static_cast<int>(heights.size());
    for (int i = 0; i < n; ++i) {
      float const x = first + step * static_cast<float>(i);
      float const over = quanta_m / depth_m[i] - (at_middle + x * (slope + x * bend));
      heights[static_cast<std::size_t>(i)] = std::max(-kFar, std::min(kFar, over * share));
    }
  }

  static void average(RowSums const& above, RowSums const& here, RowSums const& below,
                      std::span<float> result) {
    for (std::size_t u = 0; u < result.size(); ++u) {
      float const up = above.surface[u] == here.surface[u] ? 1.0F : 0.0F;
      float const down = below.surface[u] == here.surface[u] ? 1.0F : 0.0F;
      float const any = here.surface[u] != 0 ? 1.0F : 0.0F;
      float const sum = here.sums[u] + up * above.sums[u] + down * below.sums[u];
      float const count = here.counts[u] + up * above.counts[u] + down * below.counts[u];
      result[u] = any * sum / std::max(count, 1.0F);
    }
  }

  Segments const& segments_;
  Grid<float> const& depth_m_;
  double per_px_;
  double quantum_per_m_;
  double raised_quanta_;
  /// By label.
  std::vector<std::optional<FlatSurface>> surfaces_;
};

/// A connected piece of one segment that stands out.
struct Raised {
  std::vector<std::size_t> pixels;
  float highest = 0.0F;
  /// Pairs of a pixel and a neighbour outside: on the same segment, and on others.
  std::size_t on_it = 0;
  std::size_t beside = 0;
  /// Of its edge, the differences across four pixels.
  double steps = 0.0;
};

/// Levels at which pieces are looked for, the lower the better; where the surface itself is bent
/// more than that, the next.
constexpr std::array<float, 4> kLevels = {0.5F, 0.75F, 1.0F, 1.5F};
/// A thing has an edge; what a sensor bends has none.
constexpr double kLeastStep = 1.0;

class RaisedFinder {
public:
  RaisedFinder(Segments const& segments, Grid<float> const& heights, std::size_t least_px)
      : segments_(segments),
        heights_(heights),
        least_px_(least_px),
        levels_(heights.width(), heights.height()) {}

  /// In the order of their first pixels at the level where they were found.
  std::vector<Raised> found() && {
    constexpr std::size_t kStep = 16;
    for (std::size_t begin = 0; begin < heights_.size(); begin += kStep) {
      std::size_t const end = std::min(begin + kStep, heights_.size());
      // All at once, so that it vectorises; hardly any are high.
      float highest = 0.0F;
      for (std::size_t i = begin; i < end; ++i) {
        highest = std::max(highest, heights_[i]);
      }
      if (highest <= kLevels.front()) {
        continue;
      }
      for (std::size_t i = begin; i < end; ++i) {
        if (heights_[i] > kLevels.front() && levels_[i] == 0) {
          look(i, 0);
        }
      }
    }
    return std::move(found_);
  }

private:
  /// The piece around a pixel, or what of it stands out at the next level.
  void look(std::size_t first, std::size_t level) {
    Raised raised = grow(first, level);
    if (raised.highest < 1.0F || raised.pixels.size() < least_px_) {
      return;
    }
    if (is_thing(raised)) {
      keep_upper_half(raised);
      found_.push_back(std::move(raised));
    } else if (level + 1 < kLevels.size()) {
      for (std::size_t const i : raised.pixels) {
        if (heights_[i] > kLevels[level + 1] && levels_[i] == level + 1) {
          look(i, level + 1);
        }
      }
    }
  }

  /// Means over neighbours have made it wider: its edge is where it is half as high as its middle.
  void keep_upper_half(Raised& raised) const {
    std::vector<float> heights;
    for (std::size_t const i : raised.pixels) {
      heights.push_back(heights_[i]);
    }
    auto const middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::ranges::nth_element(heights, middle);
    std::erase_if(raised.pixels, [&](std::size_t i) { return heights_[i] < 0.5F * *middle; });
  }

  [[nodiscard]] static bool is_thing(Raised const& raised) {
    auto const on_it = static_cast<double>(raised.on_it);
    auto const beside = static_cast<double>(raised.beside);
    return raised.steps >= kLeastStep * on_it && beside <= kBeside * (on_it + beside);
  }

  /// Marks the piece's pixels as looked at on that level.
  Raised grow(std::size_t first, std::size_t level) {
    Raised raised;
    auto const mark = static_cast<std::uint8_t>(level + 1);
    raised.pixels.push_back(first);
    levels_[first] = mark;
    std::int32_t const base = segments_.labels[first];
    for (std::size_t i = 0; i < raised.pixels.size(); ++i) {
      raised.highest = std::max(raised.highest, heights_[raised.pixels[i]]);
      Pixel const p = heights_.pixel(raised.pixels[i]);
      for (Pixel const q :
           {Pixel{p.u, p.v - 1}, Pixel{p.u - 1, p.v}, Pixel{p.u + 1, p.v}, Pixel{p.u, p.v + 1}}) {
        if (!heights_.contains(q) || segments_.labels[q] == 0) {
          continue;
        }
        std::size_t const at = heights_.index(q);
        if (segments_.labels[q] != base) {
          ++raised.beside;
        } else if (heights_[at] <= kLevels[level]) {
          ++raised.on_it;
          raised.steps += step_across(p, q);
        } else if (levels_[at] < mark) {
          levels_[at] = mark;
          raised.pixels.push_back(at);
        }
      }
    }
    return raised;
  }

  /// How much lower it is two pixels beyond q than two pixels before p.
  [[nodiscard]] double step_across(Pixel p, Pixel q) const {
    constexpr int kAway = 2;
    Pixel const inside{p.u - kAway * (q.u - p.u), p.v - kAway * (q.v - p.v)};
    Pixel const outside{q.u + kAway * (q.u - p.u), q.v + kAway * (q.v - p.v)};
    auto const height = [&](Pixel at, Pixel otherwise) {
      bool const same = heights_.contains(at) && segments_.labels[at] == segments_.labels[p];
      return static_cast<double>(heights_[same ? at : otherwise]);
    };
    return height(inside, p) - height(outside, q);
  }

  Segments const& segments_;
  Grid<float> const& heights_;
  std::size_t least_px_;
  /// Of each pixel the level on which it was looked at last, from 1; 0 for never.
  Grid<std::uint8_t> levels_;
  std::vector<Raised> found_;
};

}  // namespace

Segments with_raised_things(Segments segments, Grid<float> const& depth_m, double focal_px,
                            SegmentsConfig const& config) {
  double const scale = focal_px / 525.0;
  auto const least_px =
      static_cast<std::size_t>(std::max(1.0, std::round(config.raised_min_pixels * scale * scale)));
  Grid<float> const heights = Relief(segments, depth_m, focal_px, config).heights();
  segments.lies_on.assign(segments.pixel_counts.size(), 0);
  for (Raised const& raised : RaisedFinder(segments, heights, least_px).found()) {
    std::int32_t const base = segments.labels[raised.pixels.front()];
    auto const pixels = static_cast<std::uint32_t>(raised.pixels.size());
    segments.pixel_counts[static_cast<std::size_t>(base - 1)] -= pixels;
    segments.pixel_counts.push_back(pixels);
    segments.lies_on.push_back(base);
    for (std::size_t const i : raised.pixels) {
      segments.labels[i] = static_cast<std::int32_t>(segments.pixel_counts.size());
    }
  }
  return segments;
}

}  // namespace credo
