#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/cloud.hpp"

namespace credo::test {

/// PCL's NormalEstimation (all points within the radius, total least squares) at some pixels of a
/// cloud, which must be valid there. Unit, facing the camera; NaN where PCL finds none.
std::vector<Eigen::Vector3f> pca_normals(OrganizedCloud const& cloud,
                                         std::vector<std::size_t> const& pixels, double radius_m);

}  // namespace credo::test
