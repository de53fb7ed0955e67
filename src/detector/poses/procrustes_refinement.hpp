#pragma once

#include <cstddef>
#include <random>

#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/poses/pose_score.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

struct ScoredPose {
  CameraPose pose;
  float score = 0.0F;
};

/// The second round of Glover and Popovic (2013): five times, some of the visible points with what
/// they fall on, of segments that fit by chance drawn, and some of the silhouette with where the
/// scene's surface ends, are aligned (geometry/bingham/procrustes.hpp); the pose is taken only if
/// its score over `score_points` rises. What lies on a plane larger than the model does not count.
/// `start` has that score already. The same for a generator in the same state.
[[nodiscard]] ScoredPose procrustes_refined(SearchModel const& model, SearchScene const& scene,
                                            PoseScore const& score, ScoredPose const& start,
                                            std::size_t score_points, std::mt19937_64& random);

}  // namespace credo
