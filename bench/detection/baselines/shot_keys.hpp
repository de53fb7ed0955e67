#pragma once

#include <Eigen/Core>

#include "model_cloud.hpp"

namespace credo {

/// Points and their SHOT descriptors, one a column, each of length 1.
struct ShotKeys {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points;
  Eigen::MatrixXf descriptors;
};

/// At points of the surface that are `spacing_m` apart. Those without a descriptor are left out.
[[nodiscard]] ShotKeys shot_keys(NormalCloud const& surface, double spacing_m, double radius_m);

/// Side by side.
[[nodiscard]] ShotKeys joined(std::vector<ShotKeys> const& parts);

}  // namespace credo
