#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"

namespace credo {

/// A model's pose in the camera frame, in floats, as the search turns over thousands of them:
/// p_camera = rotation p_model + translation.
struct CameraPose {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation_m = Eigen::Vector3f::Zero();

  Eigen::Vector3f operator*(Eigen::Vector3f const& p_model) const {
    return rotation * p_model + translation_m;
  }
};

[[nodiscard]] inline CameraPose camera_pose(Se3 const& T_camera_model) {
  return {T_camera_model.rotation().toRotationMatrix().cast<float>(),
          T_camera_model.translation().cast<float>()};
}

/// Takes rotations off by rounding.
[[nodiscard]] inline Se3 se3(CameraPose const& pose) {
  return {Eigen::Quaterniond(Eigen::Matrix3d(pose.rotation.cast<double>())),
          pose.translation_m.cast<double>()};
}

}  // namespace credo
