#pragma once

#include "core/se3.hpp"

namespace credo::test {

/// The cat's true pose in the LINEMOD frame, T_camera_model, as the dataset gives it.
inline Se3 true_cat_pose() {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() << 0.09506610, 0.98330897, -0.15512900, 0.74159598, -0.17391300,
      -0.64791101, -0.66407597, -0.05344890, -0.74575198;
  T.topRightCorner<3, 1>() << 0.07162781422, -0.15820064191, 1.05077777823;
  return Se3::from_matrix(T);
}

}  // namespace credo::test
