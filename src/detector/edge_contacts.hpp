#pragma once

#include <Eigen/Core>
#include <optional>

#include "detector/camera_pose.hpp"
#include "detector/search_model.hpp"
#include "detector/search_scene.hpp"

namespace credo {

/// A point of a model's silhouette, and where the scene's surface ends.
struct EdgeContact {
  Eigen::Vector3f point;
  /// Unit, outward, across the ray; camera frame.
  Eigen::Vector3f direction;
  /// How much farther out the scene's surface ends.
  float residual_m = 0.0F;
  float deviation_m = 0.0F;
};

/// Looks along the line through both points of a pair, 20 mm either way, for where the surface that
/// the inner one lies on ends: by a jump in depth, known to 1.5 pixels, or at another segment,
/// to 4. None where it does not end, where nothing of it is there, and where it ends behind
/// something nearer.
[[nodiscard]] std::optional<EdgeContact> edge_contact(SearchModel const& model,
                                                      SearchScene const& scene,
                                                      CameraPose const& pose,
                                                      OutlinePair const& pair);

}  // namespace credo
