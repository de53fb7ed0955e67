#pragma once

#include <Eigen/Core>

#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo::test {

/// Of boxes, 16 cm long, like no turned copy of itself; prepared once for all tests of a process.
SearchModel const& rendered_bracket();

/// The bracket at a pose before a wall 1.6 m away, its depth without noise.
SearchScene scene_with_bracket(CameraPose const& pose);

/// 0.9 m away, three of its sides to the camera.
CameraPose bracket_pose();

/// Moved by a shift and turned about the model's centre; camera frame.
CameraPose moved_off(CameraPose const& pose, Eigen::Vector3f const& shift_m,
                     Eigen::Vector3f const& turn_rad);

/// Mean distance between the model's points at two poses [m].
double mean_apart_m(CameraPose const& a, CameraPose const& b);

}  // namespace credo::test
