#include "stages/segments/convexity/region_graph.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "geometry/label_bits.hpp"
#include "stages/segments/convexity/disc_sums.hpp"
#include "stages/segments/row_bits.hpp"

namespace credo::segments {
namespace {

/// Every so many pairs of a border are looked at closely.
constexpr std::uint32_t kSampleEvery = 3;
/// What is so many times as far apart as neighbours on a surface is on two.
constexpr int kFarApart = 8;
constexpr std::int64_t kLeastPoints = 20;

/// Least squares; a little is added to the points' spread, so that a thin strip has no steep plane.
std::optional<DiscPlane> fitted(DiscSums const& sums) {
  if (sums.n < kLeastPoints) {
    return std::nullopt;
  }
  constexpr double kSpread_px2 = 0.3;
  constexpr double kQuanta = 1.0 / kUnitsPerQuantum;
  auto const n = static_cast<double>(sums.n);
  auto const mean = [&](std::int64_t sum) { return static_cast<double>(sum) / n; };
  DiscPlane plane;
  plane.mean_u = mean(sums.u);
  plane.mean_v = mean(sums.v);
  plane.mean_quanta = mean(sums.d) * kQuanta;
  double const uu = mean(sums.uu) - plane.mean_u * plane.mean_u + kSpread_px2;
  double const vv = mean(sums.vv) - plane.mean_v * plane.mean_v + kSpread_px2;
  double const uv = mean(sums.uv) - plane.mean_u * plane.mean_v;
  double const ud = mean(sums.ud) * kQuanta - plane.mean_u * plane.mean_quanta;
  double const vd = mean(sums.vd) * kQuanta - plane.mean_v * plane.mean_quanta;
  double const dd = mean(sums.dd) * kQuanta * kQuanta - plane.mean_quanta * plane.mean_quanta;
  double const determinant = uu * vv - uv * uv;
  plane.per_u = (ud * vv - vd * uv) / determinant;
  plane.per_v = (vd * uu - ud * uv) / determinant;
  plane.rms_quanta = std::sqrt(std::max(0.0, dd - plane.per_u * ud - plane.per_v * vd));
  return plane;
}

double length(double a, double b) {
  return std::sqrt(a * a + b * b);
}

/// Whether two planes are one convex surface, as far as their noise tells.
bool go_on(DiscPlane const& a, DiscPlane const& b) {
  double const noise = length(a.rms_quanta, b.rms_quanta);
  double const step = std::abs(a.at(0, 0) - b.at(0, 0));
  double const slope = std::max(length(a.per_u, a.per_v), length(b.per_u, b.per_v));
  double const concave =
      ((b.mean_quanta - a.at(b.mean_u, b.mean_v)) + (a.mean_quanta - b.at(a.mean_u, a.mean_v))) /
      2.0;
  return step < 3.0 + 3.0 * noise + slope && concave < 1.0 + 0.6 * noise;
}

class Builder {
public:
  Builder(SurfaceMap const& map, PartLabels const& labels, Limits const& limits)
      : map_(map), labels_(labels), limits_(limits), beside_(map.width()), below_(map.width()) {
    int const radius = limits.disc_px;
    for (int v = -radius; v <= radius; v += 2) {
      int u = -radius;
      while (u <= 0 && u * u + v * v > radius * radius) {
        u += 2;
      }
      if (u <= 0) {
        disc_.push_back({u, v});
      }
    }
  }

  RegionGraph graph() && {
    for (int v = 0; v < map_.height(); ++v) {
      look_along(v);
    }
    std::ranges::sort(graph_.borders, {},
                      [](Border const& border) { return std::pair(border.low, border.high); });
    return std::move(graph_);
  }

private:
  /// The borders of a row's pixels to what is beside them and below. Behind the last row and column
  /// there is no label, and so no border.
  void look_along(int v) {
    std::int32_t const* const row = labels_.row(v);
    int const width = map_.width();
    mark_different(row, row + 1, static_cast<std::size_t>(width), beside_.data());
    mark_different(row, row + labels_.stride(), static_cast<std::size_t>(width), below_.data());
    int begin = 0;
    for (int u = next_border(0); u < width; u = next_border(u + 1)) {
      if (beside_.contains(u)) {
        count(row[begin], static_cast<std::uint32_t>(u + 1 - begin));
        begin = u + 1;
        look(u, v, 1);
      }
      if (below_.contains(u)) {
        look(u, v, labels_.stride());
      }
    }
    if (begin < width) {
      count(row[begin], static_cast<std::uint32_t>(width - begin));
    }
  }

  [[nodiscard]] int next_border(int u) const {
    return std::min(beside_.next_set(u), below_.next_set(u));
  }

  void count(std::int32_t label, std::uint32_t pixels) {
    auto const index = static_cast<std::size_t>(label);
    if (index >= graph_.sizes.size()) {
      graph_.sizes.resize(index + 1, 0);
    }
    graph_.sizes[index] += pixels;
  }

  Border& border_of(std::int32_t a, std::int32_t b) {
    std::int32_t const low = std::min(a, b);
    std::int32_t const high = std::max(a, b);
    std::uint64_t const key =
        (static_cast<std::uint64_t>(low) << 32U) | static_cast<std::uint64_t>(high);
    if (key != last_key_) {
      auto const [found, is_new] = index_.try_emplace(key, graph_.borders.size());
      if (is_new) {
        graph_.borders.push_back({low, high});
      }
      last_key_ = key;
      last_ = found->second;
    }
    return graph_.borders[last_];
  }

  void look(int u, int v, std::ptrdiff_t step) {
    std::ptrdiff_t const at = v * labels_.stride() + u;
    std::int32_t const a = labels_.row(0)[at];
    std::int32_t const b = labels_.row(0)[at + step];
    if (a == 0 || b == 0) {
      return;
    }
    Border& border = border_of(a, b);
    std::int16_t const* const disparity = map_.disparity.row(0);
    std::uint8_t const* const wall = map_.wall.row(0);
    int const jump = std::abs(disparity[at] - disparity[at + step]);
    bool const parted = jump >= limits_.link || wall[at] != 0 || wall[at + step] != 0;
    border.parted += parted ? 1 : 0;
    if (border.pairs++ % kSampleEvery == 0) {
      if (jump >= kFarApart * limits_.link) {
        // No surface is that steep: many a disc of a full view is spared.
        ++border.samples;
        ++border.unlike;
      } else {
        sample(border, u, v, at, step);
      }
    }
  }

  void sample(Border& border, int u, int v, std::ptrdiff_t at, std::ptrdiff_t step) {
    rows_.clear();
    for (auto const [begin, dv] : disc_) {
      if (v + dv >= 0 && v + dv < map_.height()) {
        // Every second pixel, whatever the image cuts off.
        int const first = u + begin < 0 ? begin + (1 - u - begin) / 2 * 2 : begin;
        rows_.push_back({dv, first, std::min(-begin, map_.width() - 1 - u)});
      }
    }
    std::int32_t const* const label = labels_.row(0) + at;
    auto const sums = disc_sums({label, map_.disparity.row(0) + at, labels_.stride()}, rows_,
                                label[0], label[step]);
    auto const plane_a = fitted(sums.a);
    auto const plane_b = fitted(sums.b);
    if (plane_a && plane_b) {
      ++border.samples;
      border.unlike += go_on(*plane_a, *plane_b) ? 0 : 1;
      graph_.samples.push_back({at, at + step, *plane_a, *plane_b});
    }
  }

  SurfaceMap const& map_;
  PartLabels const& labels_;
  Limits const& limits_;
  /// Of each row of a disc its first pixel.
  std::vector<Pixel> disc_;
  /// Those of the disc that is looked at.
  std::vector<DiscRow> rows_;
  /// Where in a row the next pixel, or the one below, has another label.
  RowBits beside_;
  RowBits below_;
  RegionGraph graph_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::uint64_t last_key_ = 0;
  std::size_t last_ = 0;
};

}  // namespace

RegionGraph region_graph(SurfaceMap const& map, PartLabels const& labels, Limits const& limits) {
  return Builder(map, labels, limits).graph();
}

}  // namespace credo::segments
