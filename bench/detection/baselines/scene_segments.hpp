#pragma once

#include <vector>

#include "refinement.hpp"
#include "scene_cloud.hpp"

namespace credo {

/// The points of one of the segments of a scene.
struct SegmentCloud {
  /// In random order.
  NormalCloud::Ptr points;
  Eigen::Vector3f middle;
  /// The widest of some pairs of its points.
  double extent_m = 0.0;

  /// Whether it could be what is seen of a model of that size: not larger than the model by more
  /// than the sensor's error, and not too small a part of it.
  [[nodiscard]] bool could_be(double diameter_m) const;
};

/// The segments that have at least 25 points.
[[nodiscard]] std::vector<SegmentCloud> segments_of(SceneCloud const& scene);

/// Share of a segment's points that are on the model's surface: each counts one less its squared
/// distance, and nothing from a centimetre on.
[[nodiscard]] double share_on_model(NormalCloud const& segment, SearchedCloud const& model,
                                    Eigen::Isometry3f const& pose_camera);

}  // namespace credo
