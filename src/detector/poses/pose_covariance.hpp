#pragma once

#include "core/se3.hpp"
#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

/// How firmly the scene holds a pose (boxplus in the camera frame), by its points, its silhouette
/// and what is known without looking: a metre, two radians; as if errors had nothing in common. It
/// tells in which direction a pose is loosest. Positive definite.
[[nodiscard]] Matrix6d pose_information(SearchModel const& model, SearchScene const& scene,
                                        CameraPose const& pose);

/// How sure the scene alone makes of a pose, in the camera frame (boxplus): no expectation enters.
/// It is what errors of the measured surface and silhouette, of each point and of all together,
/// make of a refined pose (pose_evidence.hpp; the "sandwich" of Huber 1967, errors in common as
/// Schmidt 1966 considers them), times how much worse it lies on what is seen than right poses do.
/// Along what cannot be seen, such as turns about a symmetry axis or shifts along a bare edge, it
/// is a metre, or two radians. Where several turns explain the frame about as well, such as those
/// of a mug whose handle is hidden, the mean is amid them and the covariance spreads over them
/// (open_turn.hpp). Positive definite.
[[nodiscard]] PoseDistribution with_covariance(SearchModel const& model, SearchScene const& scene,
                                               CameraPose const& pose);

}  // namespace credo
