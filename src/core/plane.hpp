#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"

namespace credo {

/// The plane normal . p = offset_m. The normal is a unit vector; its side is the positive one.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset_m = 0.0;

  [[nodiscard]] double signed_distance_m(Eigen::Vector3d const& point) const {
    return normal.dot(point) - offset_m;
  }
  [[nodiscard]] Plane flipped() const { return {-normal, -offset_m}; }
};

/// The same plane told in frame a.
[[nodiscard]] inline Plane transformed(Se3 const& T_a_b, Plane const& plane_b) {
  Eigen::Vector3d const normal = T_a_b.rotation() * plane_b.normal;
  return {normal, plane_b.offset_m + normal.dot(T_a_b.translation())};
}

}  // namespace credo
