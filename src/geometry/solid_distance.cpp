#include "geometry/solid_distance.hpp"

#include <algorithm>
#include <cmath>

namespace credo {
namespace {

/// To a rectangle (or box) around the origin, told by how far the point is beyond each pair of
/// sides: negative between them. Outside, the nearest point may lie on an edge or a corner.
template <int kSides>
SurfaceDistance distance_beyond(Eigen::Matrix<double, kSides, 1> const& beyond,
                                Eigen::Matrix<double, 3, kSides> const& outward) {
  Eigen::Matrix<double, kSides, 1> const outside = beyond.cwiseMax(0.0);
  double const distance = outside.norm();
  if (distance > 0.0) {
    return {distance, outward * outside / distance};
  }
  Eigen::Index nearest = 0;
  double const depth = beyond.maxCoeff(&nearest);
  return {depth, outward.col(nearest)};
}

SurfaceDistance distance_from(BoxSolid const& box, Eigen::Vector3d const& point) {
  Eigen::Vector3d const offset = point - 0.5 * (box.low_m + box.high_m);
  Eigen::Vector3d const beyond = offset.cwiseAbs() - 0.5 * (box.high_m - box.low_m);
  Eigen::Matrix3d outward = Eigen::Matrix3d::Zero();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    outward(axis, axis) = std::copysign(1.0, offset[axis]);
  }
  return distance_beyond<3>(beyond, outward);
}

SurfaceDistance distance_from(CylinderSolid const& cylinder, Eigen::Vector3d const& point) {
  double const from_axis = std::hypot(point.x(), point.y());
  double const half = 0.5 * cylinder.height_m;
  Eigen::Matrix<double, 3, 2> outward = Eigen::Matrix<double, 3, 2>::Zero();
  if (from_axis > 0.0) {
    outward.col(0) << point.x() / from_axis, point.y() / from_axis, 0.0;
  } else {
    outward.col(0) = Eigen::Vector3d::UnitX();
  }
  outward(2, 1) = std::copysign(1.0, point.z() - half);
  return distance_beyond<2>({from_axis - cylinder.radius_m, std::abs(point.z() - half) - half},
                            outward);
}

SurfaceDistance distance_from(SphereSolid const& sphere, Eigen::Vector3d const& point) {
  Eigen::Vector3d const offset = point - Eigen::Vector3d(0, 0, sphere.radius_m);
  double const from_centre = offset.norm();
  return {from_centre - sphere.radius_m,
          from_centre > 0.0 ? Eigen::Vector3d(offset / from_centre) : Eigen::Vector3d::UnitZ()};
}

bool has_face(BoxSolid const& box, Eigen::Vector3d const& point, double radius_m,
              DirectionCone const& cone) {
  Eigen::Vector3d const inside = point.cwiseMax(box.low_m).cwiseMin(box.high_m);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (double const sign : {-1.0, 1.0}) {
      Eigen::Vector3d on_face = inside;
      on_face[axis] = (sign < 0.0 ? box.low_m : box.high_m)[axis];
      if (sign * cone.axis[axis] > cone.min_cosine &&
          (point - on_face).squaredNorm() <= radius_m * radius_m) {
        return true;
      }
    }
  }
  return false;
}

bool has_face(CylinderSolid const& cylinder, Eigen::Vector3d const& point, double radius_m,
              DirectionCone const& cone) {
  double const from_axis = std::hypot(point.x(), point.y());
  double const beside = std::max(from_axis - cylinder.radius_m, 0.0);
  for (double const end : {0.0, cylinder.height_m}) {
    if (std::hypot(beside, point.z() - end) <= radius_m &&
        cone.holds({0.0, 0.0, end > 0.0 ? 1.0 : -1.0})) {
      return true;
    }
  }
  double const beyond = point.z() - std::clamp(point.z(), 0.0, cylinder.height_m);
  return from_axis > 0.0 && std::hypot(from_axis - cylinder.radius_m, beyond) <= radius_m &&
         cone.holds({point.x() / from_axis, point.y() / from_axis, 0.0});
}

bool has_face(SphereSolid const& sphere, Eigen::Vector3d const& point, double radius_m,
              DirectionCone const& cone) {
  SurfaceDistance const surface = distance_from(sphere, point);
  return std::abs(surface.distance_m) <= radius_m && cone.holds(surface.normal);
}

}  // namespace

SurfaceDistance distance_to(Solid const& solid, Eigen::Vector3d const& point) {
  return std::visit([&](auto const& body) { return distance_from(body, point); }, solid);
}

bool has_face_near(Solid const& solid, Eigen::Vector3d const& point, double radius_m,
                   DirectionCone const& cone) {
  return std::visit([&](auto const& body) { return has_face(body, point, radius_m, cone); }, solid);
}

}  // namespace credo
