#pragma once

#include <cstddef>
#include <vector>

#include "core/detection.hpp"
#include "model_cloud.hpp"
#include "scene_cloud.hpp"

namespace credo {

/// How a model at a pose fits the depth image.
struct Agreement {
  /// Shares of the points that are turned to the camera and that the model itself does not hide:
  /// at the depth seen, less where a surface is off it; behind what is seen; in front of it, where
  /// the camera looks through.
  double explained = 0.0;
  double hidden = 0.0;
  double looked_through = 0.0;
  /// Where the explained ones are, pixels in blocks of four by four.
  std::vector<std::size_t> blocks;

  /// Explained less looked through, over all but half of the hidden.
  [[nodiscard]] double score() const;
};

/// The depth seen is met within the sensor's error and `slack_m`, for poses that are still rough.
[[nodiscard]] Agreement agreement(NormalCloud const& model, Eigen::Isometry3f const& pose_camera,
                                  SceneCloud const& scene, float slack_m = 0.0F);

/// A pose of a model among the candidates for a frame.
struct Candidate {
  std::string model;
  Eigen::Isometry3f pose_camera;
  double score = 0.0;
  Agreement fit;
};

/// The best candidate first, then each next that is mostly in blocks that none before it has, one a
/// model. Those below the least score are left out.
[[nodiscard]] std::vector<Detection> best_candidates(std::vector<Candidate> candidates,
                                                     double least_score);

/// As a detection: PCL's methods know no covariance, so it is always a centimetre and a tenth of a
/// radian.
[[nodiscard]] Detection detection_of(Candidate const& candidate);

}  // namespace credo
