#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "stages/segments/convexity/limits.hpp"
#include "stages/segments/padded_grid.hpp"

namespace credo::segments {

/// What the pixels' surroundings say of them.
struct SurfaceMap {
  /// Inverse depth in units; 0 where there is none.
  PaddedGrid<std::int16_t> disparity;
  /// How concave the smoothed surface is there, in units.
  PaddedGrid<std::int16_t> concavity;
  /// 1 on creases.
  PaddedGrid<std::uint8_t> wall;
  /// 0 on creases, at jumps and without depth; else how many pixels these are away, at most 4.
  PaddedGrid<std::uint8_t> thickness;

  [[nodiscard]] int width() const { return disparity.width(); }
  [[nodiscard]] int height() const { return disparity.height(); }
};

[[nodiscard]] SurfaceMap map_surfaces(Grid<float> const& depth_m, Limits const& limits);

/// Whether two neighbours, both with depth, are on one surface.
[[nodiscard]] inline bool linked(std::int16_t a, std::int16_t b, std::int16_t limit) {
  int const difference = a - b;
  return difference < limit && -difference < limit;
}

}  // namespace credo::segments
