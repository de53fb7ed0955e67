#pragma once

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/sim_config.hpp"
#include "geometry/depth_registration.hpp"
#include "sim/scene.hpp"

namespace credo::test {

/// What the two cameras of a Kinect (kinect_calibration) see of a scene, 640 x 480.
struct SensorViews {
  /// Of the depth camera.
  Grid<float> depth_m;
  /// As if the depth camera stood where the colour camera stands.
  Grid<float> registered_m;
  /// Blurred over 3 x 3 pixels.
  Grid<Rgb> color;
};

/// The colour camera is the scene's own, with a Kinect's focal length, so long after its first
/// waypoint.
SensorViews sensor_views(Scene scene, SensorModel model, double since_s);

}  // namespace credo::test
