#pragma once

#include <Eigen/Core>
#include <vector>

#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"

namespace credo {

/// How far two poses of a model are apart [m]: the distance of their centres and 0.35 diameters for
/// each radian of turn, least over the model's symmetry.
class PoseDistance {
public:
  explicit PoseDistance(SearchModel const& model);
  [[nodiscard]] float operator()(CameraPose const& a, CameraPose const& b) const;

private:
  Eigen::Vector3f centre_model_;
  float per_rad_m_;
  bool has_axis_ = false;
  bool both_ways_ = false;
  Eigen::Vector3f axis_model_ = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f on_axis_model_ = Eigen::Vector3f::Zero();
  /// The same, turned end for end.
  Eigen::Vector3f on_axis_turned_model_ = Eigen::Vector3f::Zero();
  /// With the identity.
  std::vector<Eigen::Matrix3f> rotations_;
};

}  // namespace credo
