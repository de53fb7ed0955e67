#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/belief.hpp"
#include "core/frame.hpp"
#include "core/segmentation.hpp"
#include "io/canvas.hpp"

namespace credo::test {

/// A level camera 1.5 m above the world's origin that looks along x.
inline Se3 level_camera() {
  Eigen::Matrix3d rotation;
  rotation.col(0) = -Eigen::Vector3d::UnitY();
  rotation.col(1) = -Eigen::Vector3d::UnitZ();
  rotation.col(2) = Eigen::Vector3d::UnitX();
  return {Eigen::Quaterniond(rotation), {0, 0, 1.5}};
}

/// All depth 2 m, no colour.
inline Frame plain_frame(int width, int height) {
  Frame frame;
  frame.cloud_camera =
      cloud_from_depth(Grid<float>(width, height, 2.0F), {100, 100, 0.5 * width, 0.5 * height});
  return frame;
}

/// What the frame shows before any stage has labelled it.
inline Segmentation plain_segmentation(Frame const& frame) {
  return unassigned_segmentation(frame, level_camera(), kPriorFrame);
}

inline BeliefState plain_belief() {
  BeliefState belief;
  belief.T_world_camera = level_camera();
  return belief;
}

// The panels of a picture of a 320x240 frame.
inline constexpr Panel kCameraPanel = {0, 0, 160, 120};
inline constexpr Panel kOblique = {0, 124, 160, 120};
inline constexpr Panel kMap = {164, 124, 160, 120};

}  // namespace credo::test
