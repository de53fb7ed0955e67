#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "stages/segments/segments.hpp"

// convex_segments pixel by pixel, step by step, as slowly and as plainly as it can be said: its
// oracle. Heights are whole sixteenths of a quantum, beyond the image everything is 0.

namespace credo::test {

/// The config for one camera.
struct LiteralLimits {
  double units_m = 0.0;
  int link = 0;
  int smooth = 0;
  int smooth_radius_px = 0;
  int reach_px = 0;
  int diagonal_px = 0;
  int reach = 0;
  /// Over 2^15.
  int far_weight = 0;
  int crease = 0;
  double crease_noise = 0.0;
  /// Over 2^16.
  int slope = 0;
  int disc_px = 0;
  int seed_px = 0;
  int part_px = 0;
  int small_px = 0;
  int border_px = 0;
};
LiteralLimits literal_limits(double focal_px, SegmentsConfig const& config);

struct LiteralSurfaces {
  Grid<int> disparity;
  Grid<int> concavity;
  Grid<std::uint8_t> wall;
  Grid<std::uint8_t> thickness;
};
LiteralSurfaces literal_surfaces(Grid<float> const& depth_m, LiteralLimits const& limits);

/// Labels from 1.
Grid<int> literal_parts(LiteralSurfaces const& surfaces, LiteralLimits const& limits);

/// The parts joined where nothing holds them apart, and their borders sharpened.
void join_literal_parts(LiteralSurfaces const& surfaces, LiteralLimits const& limits,
                        Grid<int>& labels);

/// All of it.
Segments literal_convex_segments(Grid<float> const& depth_m, double focal_px,
                                 SegmentsConfig const& config);

}  // namespace credo::test
