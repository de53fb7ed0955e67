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

/// The directions within an angle of a unit vector.
struct DirectionCone {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double min_cosine = 0.0;

  [[nodiscard]] bool holds(Eigen::Vector3d const& direction) const {
    return axis.dot(direction) > min_cosine;
  }
};

/// From a point in the solid's frame to its surface. Where several points of the surface are as
/// near (on the axis of a cylinder, in the middle of a box), the normal is that of one of them.
[[nodiscard]] SurfaceDistance distance_to(Solid const& solid, Eigen::Vector3d const& point);

/// Whether one of the solid's faces that are within `radius_m` of the point has its normal, at the
/// face's point nearest to it, in the cone. A box has six faces, a cylinder three, a sphere one.
[[nodiscard]] bool has_face_near(Solid const& solid, Eigen::Vector3d const& point, double radius_m,
                                 DirectionCone const& cone);

}  // namespace credo
