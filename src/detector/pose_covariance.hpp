#pragma once

#include "core/se3.hpp"
#include "detector/camera_pose.hpp"
#include "detector/search_model.hpp"
#include "detector/search_scene.hpp"

namespace credo {

/// What the scene tells of small errors of a pose (boxplus in the camera frame), by its points, its
/// silhouette and what is known without looking: a metre, two radians. Positive definite.
[[nodiscard]] Matrix6d pose_information(SearchModel const& model, SearchScene const& scene,
                                        CameraPose const& pose);

/// How sure the scene alone makes of a pose, in the camera frame (boxplus): no expectation enters.
/// Along what cannot be seen, such as turns about a symmetry axis or shifts along a bare edge, it
/// is a metre, or two radians. Where several turns explain the frame about as well, such as those
/// of a mug whose handle is hidden, the mean is amid them and the covariance spreads over them
/// (open_turn.hpp). Positive definite.
[[nodiscard]] PoseDistribution with_covariance(SearchModel const& model, SearchScene const& scene,
                                               CameraPose const& pose);

}  // namespace credo
