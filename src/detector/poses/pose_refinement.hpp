#pragma once

#include <cstddef>

#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

struct RefinementConfig {
  int iterations = 5;
  /// So many of the points that the nearest view shows.
  std::size_t points = 250;
  /// A point that is farther from what it falls on does not count.
  float gate_m = 0.02F;
};

/// The last, of a pose that is nearly right.
inline constexpr RefinementConfig kFinestRefinement = {8, 800, 0.012F};

/// A pose moved to where the scene's surface is: point-to-plane ICP along the model's normals
/// (Chen and Medioni 1992) with projective association and Cauchy weights. What lies on a plane
/// larger than the model does not count, nor where normals differ by more than 60 degrees. With
/// fewer than 6 points that count, the pose as it is.
[[nodiscard]] CameraPose refined(SearchModel const& model, SearchScene const& scene,
                                 CameraPose const& pose, RefinementConfig const& config);

}  // namespace credo
