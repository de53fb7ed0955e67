#include "stages/segments/surface_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "stages/segments/kernels.hpp"

namespace credo::segments {
namespace {

using Heights = PaddedGrid<std::int16_t>;
using Bytes = PaddedGrid<std::uint8_t>;

Heights disparity_of(Grid<float> const& depth_m, Limits const& limits) {
  int const width = depth_m.width();
  int const height = depth_m.height();
  auto const count = static_cast<std::size_t>(width);
  Heights disparity(width, height);
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
  Heights smooth(disparity.width(), disparity.height());
  for (int v = 0; v < disparity.height(); ++v) {
    smooth_row(disparity.row(v), disparity.stride(), limits.smooth_radius_px, limits.smooth,
               static_cast<std::size_t>(disparity.width()), smooth.row(v));
    smooth.end_row(v);
  }
  return smooth;
}

/// The frame's own noise: what three quarters of the pixels on a coarse grid are less concave than.
int noise_of(Heights const& disparity, Heights const& concavity) {
  std::vector<std::int16_t> sample;
  for (int v = 0; v < disparity.height(); v += 3) {
    for (int u = 0; u < disparity.width(); u += 5) {
      if (disparity.row(v)[u] > 0) {
        sample.push_back(concavity.row(v)[u]);
      }
    }
  }
  if (sample.empty()) {
    return 0;
  }
  auto const middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() * 3 / 4);
  std::nth_element(sample.begin(), middle, sample.end());
  return *middle;
}

void thicken(Bytes& thickness, std::uint8_t level) {
  Bytes thicker(thickness.width(), thickness.height());
  for (int v = 0; v < thickness.height(); ++v) {
    thicken_row(thickness.row(v), thickness.stride(), level,
                static_cast<std::size_t>(thickness.width()), thicker.row(v));
    thicker.end_row(v);
  }
  std::swap(thickness, thicker);
}

}  // namespace

SurfaceMap map_surfaces(Grid<float> const& depth_m, Limits const& limits) {
  int const width = depth_m.width();
  int const height = depth_m.height();
  auto const count = static_cast<std::size_t>(width);
  SurfaceMap map{disparity_of(depth_m, limits), Heights(width, height), Bytes(width, height),
                 Bytes(width, height)};
  Heights const smooth = smoothed(map.disparity, limits);
  Heights steepness(width, height);
  std::ptrdiff_t const reach = limits.reach_px;
  std::ptrdiff_t const diagonal = limits.diagonal_px;
  std::array<std::ptrdiff_t, 4> const offsets = {reach, reach * smooth.stride(),
                                                 diagonal * (smooth.stride() + 1),
                                                 diagonal * (1 - smooth.stride())};
  for (int v = 0; v < height; ++v) {
    concavity_row(smooth.row(v), offsets, limits.reach, count, map.concavity.row(v),
                  steepness.row(v));
    map.concavity.end_row(v);
  }
  int const noise = noise_of(map.disparity, map.concavity);
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
  for (std::uint8_t level = 1; level <= 3; ++level) {
    thicken(map.thickness, level);
  }
  return map;
}

}  // namespace credo::segments
