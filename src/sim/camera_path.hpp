#pragma once

#include <vector>

#include "core/se3.hpp"
#include "sim/scene.hpp"

namespace credo {

/// Where the camera is at a time: T_world_camera, optical frame, upright. Position and aim follow a
/// Catmull-Rom spline (Catmull and Rom 1974) through the waypoints; before the first and after the
/// last the camera rests. `path` is checked (check_scene).
Se3 camera_pose(std::vector<SceneWaypoint> const& path, double time_s);

}  // namespace credo
