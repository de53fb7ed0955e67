#include "stages/segments/convexity/surface_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "stages/segments/convexity/kernels.hpp"

namespace credo::segments {
namespace {

using Heights = PaddedGrid<std::int16_t>;
using Bytes = PaddedGrid<std::uint8_t>;

Heights disparity_of(Grid<float> const& depth_m, Limits const& limits) {
  int const width = depth_m.width();
  int const height = depth_m.height();
  auto const count = static_cast<std::size_t>(width);
  Heights disparity(width, height, Heights::kFewMarginRows);
  // Behind the last row nothing may be read.
  std::vector<float> last(count + Heights::kMargin, 0.0F);
  for (int v = 0; v < height; ++v) {
    float const* row = depth_m.data() + static_cast<std::size_t>(v) * count;
    if (v + 1 == height || width < Heights::kMargin) {
      std::copy_n(row, count, last.begin());
      row = last.data();
    }
    disparity_row(row, count, limits.units_m, disparity.row(v));
    disparity.end_row(v);
  }
  return disparity;
}

Heights smoothed(Heights const& disparity, Limits const& limits) {
  Heights smooth(disparity.width(), disparity.height(),
                 2 * std::max(limits.reach_px, limits.diagonal_px));
  for (int v = 0; v < disparity.height(); ++v) {
    smooth_row(disparity.row(v), disparity.stride(), limits.smooth_radius_px, limits.smooth,
               static_cast<std::size_t>(disparity.width()), smooth.row(v));
    smooth.end_row(v);
  }
  return smooth;
}

/// The frame's own noise: what three quarters of the pixels on a coarse grid are less concave than.
int noise_of(Heights const& disparity, Heights const& concavity, Limits const& limits) {
  // Counted by value: there are few, none below 0, and none as high as two reaches.
  std::vector<std::uint32_t> counts(2 * static_cast<std::size_t>(std::max<int>(limits.reach, 1)),
                                    0);
  std::uint32_t total = 0;
  for (int v = 0; v < disparity.height(); v += 3) {
    for (int u = 0; u < disparity.width(); u += 5) {
      if (disparity.row(v)[u] > 0) {
        ++counts[static_cast<std::size_t>(concavity.row(v)[u])];
        ++total;
      }
    }
  }
  std::uint32_t less = 0;
  for (std::size_t value = 0; value < counts.size(); ++value) {
    less += counts[value];
    if (less > total * std::uint64_t{3} / 4) {
      return static_cast<int>(value);
    }
  }
  return 0;
}

void thicken(Bytes const& thickness, std::uint8_t level, Bytes& thicker) {
  for (int v = 0; v < thickness.height(); ++v) {
    thicken_row(thickness.row(v), thickness.stride(), level,
                static_cast<std::size_t>(thickness.width()), thicker.row(v));
    thicker.end_row(v);
  }
}

}  // namespace

SurfaceMap map_surfaces(Grid<float> const& depth_m, Limits const& limits) {
  int const width = depth_m.width();
  int const height = depth_m.height();
  auto const count = static_cast<std::size_t>(width);
  constexpr int kRows = Heights::kFewMarginRows;
  SurfaceMap map{disparity_of(depth_m, limits), Heights(width, height, kRows),
                 Bytes(width, height, kRows), Bytes(width, height, kRows)};
  Heights const smooth = smoothed(map.disparity, limits);
  Heights steepness(width, height, kRows);
  std::ptrdiff_t const reach = limits.reach_px;
  std::ptrdiff_t const diagonal = limits.diagonal_px;
  ConcavityPairs const pairs{{reach, reach * smooth.stride(), diagonal * (smooth.stride() + 1),
                              diagonal * (1 - smooth.stride())},
                             limits.reach,
                             limits.far_weight};
  for (int v = 0; v < height; ++v) {
    concavity_row(smooth.row(v), pairs, count, map.concavity.row(v), steepness.row(v));
    map.concavity.end_row(v);
  }
  int const noise = noise_of(map.disparity, map.concavity, limits);
  int const crease =
      std::max(limits.crease, static_cast<int>(std::lround(limits.crease_noise * noise)));
  CreaseLimits const creases{static_cast<std::int16_t>(std::min(crease, 32000)), limits.slope,
                             limits.link};
  for (int v = 0; v < height; ++v) {
    crease_row(map.disparity.row(v), map.disparity.stride(), map.concavity.row(v), steepness.row(v),
               creases, count, map.wall.row(v), map.thickness.row(v));
    map.wall.end_row(v);
    map.thickness.end_row(v);
  }
  Bytes thicker(width, height, kRows);
  for (std::uint8_t level = 1; level <= 3; ++level) {
    thicken(map.thickness, level, thicker);
    std::swap(map.thickness, thicker);
  }
  return map;
}

}  // namespace credo::segments
