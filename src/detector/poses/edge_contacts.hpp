#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/search_scene.hpp"

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

/// What the scene shows at a point of a silhouette.
enum class EdgeVerdict : std::uint8_t {
  /// The surface ends.
  kFound,
  /// It goes on, or nothing of it is there.
  kOpen,
  /// Something stands before it, or depth is missing.
  kHidden,
};

struct EdgeLook {
  EdgeVerdict verdict = EdgeVerdict::kHidden;
  /// If found.
  EdgeContact contact;
};

/// Looks along the line through both points of a pair, 20 mm either way, for where the surface that
/// the inner one lies on ends: by a jump in depth, known to 1.5 pixels, or at another segment,
/// to 4.
[[nodiscard]] EdgeLook look_at_edge(SearchModel const& model, SearchScene const& scene,
                                    CameraPose const& pose, OutlinePair const& pair);

}  // namespace credo
