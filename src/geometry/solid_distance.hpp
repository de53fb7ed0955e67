#pragma once

#include <Eigen/Core>

#include "core/solid.hpp"

namespace credo {

/// How far a point is from a surface, and which way the surface faces there.
struct SurfaceDistance {
  /// Negative inside.
  double distance_m = 0.0;
  /// Unit, outward: the direction in which the distance grows.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// From a point in the solid's frame to its surface. Where several points of the surface are as
/// near (on the axis of a cylinder, in the middle of a box), the normal is that of one of them.
[[nodiscard]] SurfaceDistance distance_to(Solid const& solid, Eigen::Vector3d const& point);

}  // namespace credo
