#pragma once

#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/segments.hpp"

namespace credo::test {

/// with_raised_things pixel by pixel: heights from all nine pixels, pieces that grow from a pixel
/// and from scratch for each level. Its oracle.
Segments literal_raised_things(Segments segments, Grid<float> const& depth_m, double focal_px,
                               SegmentsConfig const& config);

}  // namespace credo::test
