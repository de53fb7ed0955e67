#pragma once

#include <Eigen/Core>

namespace credo {

/// A point and its unit normal.
struct OrientedPoint {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;
};

}  // namespace credo
