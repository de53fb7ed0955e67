#pragma once

#include <cstdint>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "model_cloud.hpp"

namespace credo {

/// What stands on the table of a frame.
struct SceneCloud {
  /// Each second pixel of it, with normals turned to the camera.
  NormalCloud::Ptr points;
  /// Which of Credo's segments each of `points` is of; from 0.
  std::vector<int> segment;
  int segment_count = 0;
  /// Of the frame.
  Grid<float> depth_m;
  CameraIntrinsics intrinsics;
};

/// Takes the largest plane that faces up and is nearest for the table, and what is over it, from a
/// centimetre up to 60, for things. Without such a plane everything within 2 m is.
[[nodiscard]] SceneCloud scene_cloud(Frame const& frame);

}  // namespace credo
