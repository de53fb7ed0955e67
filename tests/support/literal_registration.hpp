#pragma once

#include "core/grid.hpp"
#include "geometry/depth_registration.hpp"

namespace credo::test {

/// register_depth as its comment says it: for every pixel of the colour image, all depth pixels
/// are asked whether it lies in their footprint. In doubles, point by point.
Grid<float> literal_registration(Grid<float> const& depth_m, DepthCalibration const& calibration,
                                 int width, int height);

}  // namespace credo::test
