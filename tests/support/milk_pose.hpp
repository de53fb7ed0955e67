#pragma once

#include "core/se3.hpp"

namespace credo::test {

/// Where the milk carton of objects/milk.pcd stands in frames/milk, optical axes: its points are
/// those of the scene, moved. By ICP, which leaves less than a thousandth of a millimetre.
inline Se3 true_milk_pose() {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() << 0.968879414, 0.119712210, -0.216660259, -0.116826833, 0.992808636,
      0.026124781, 0.218229631, 0.0, 0.975897447;
  T.topRightCorner<3, 1>() << -0.158965059, -0.212498155, 0.042125589;
  return Se3::from_matrix(T);
}

}  // namespace credo::test
