#pragma once

#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/padded_grid.hpp"
#include "stages/segments/segments.hpp"

namespace credo::segments {

/// What stands out of the large flat segments of an image: of each pixel, by how much of what a
/// thing must stand out it does, as the mean over what is of its segment among itself and its eight
/// neighbours. 1 or more is a thing's middle. 0 where there is no flat surface.
[[nodiscard]] PaddedGrid<float> relief(Segments const& segments, Grid<float> const& depth_m,
                                       double focal_px, SegmentsConfig const& config);

}  // namespace credo::segments
