#pragma once

#include "core/grid.hpp"
#include "stages/segments/segments.hpp"

namespace credo::test {

/// convex_segments pixel by pixel, step by step, as slowly and as plainly as it can be said: its
/// oracle.
Segments literal_convex_segments(Grid<float> const& depth_m, double focal_px,
                                 SegmentsConfig const& config);

}  // namespace credo::test
