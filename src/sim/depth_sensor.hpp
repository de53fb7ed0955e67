#pragma once

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/sim_config.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scene.hpp"

namespace credo {

/// The depth [m] that a Kinect would measure of a view, 0 where it measures none:
///  - no depth of glass, beyond the camera's range, at grazing incidence (fading out from 70 to 85
///    degrees), of dark surfaces far away (fading out from 2 to 4 m) and in the mirror image of the
///    projector on shiny ones (within 8 degrees of square, and beyond 50)
///  - no depth where the projector, 7.5 cm to the right of the camera, does not reach: a shadow to
///    the left of what stands in front
///  - noise by `model`. Gaussian: laterally 0.8 px and axially 1.2 mm at 0.4 m, growing with the
///    range squared and with incidence (Nguyen, Izadi, Lovell 2012). Disparity: shifted by half a
///    pixel, then rounded to eighths of a pixel of disparity with a noise of a sixth of one (Barron
///    and Malik 2013, in the unbiased form)
/// Depth comes in whole millimetres. The ideal model measures `view.depth_m`, but for glass. The
/// same for the same seed and frame, at any number of threads. How the fading of dark, shiny and
/// grazed surfaces looks is ours, by eye.
Grid<float> measured_depth(RenderedView const& view, Scene const& scene, SensorModel model,
                           int seed, FrameIndex index);

}  // namespace credo
