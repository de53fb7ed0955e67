#include "geometry/shapes/solid_distance.hpp"

#include <algorithm>
#include <cmath>

namespace credo {
namespace {

SurfaceDistance distance_from(BoxSolid const& box, Eigen::Vector3d const& point) {
  Eigen::Vector3d const offset = point - 0.5 * (box.low_m + box.high_m);
  Eigen::Vector3d const beyond = offset.cwiseAbs() - 0.5 * (box.high_m - box.low_m);
  Eigen::Vector3d const outside = beyond.cwiseMax(0.0);
  double const distance2 = outside.squaredNorm();
  if (distance2 > 0.0) {
    double const distance = std::sqrt(distance2);
    Eigen::Vector3d normal = outside / distance;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      normal[axis] = std::copysign(normal[axis], offset[axis]);
    }
    return {distance, normal};
  }
  Eigen::Index nearest = 0;
  double const depth = beyond.maxCoeff(&nearest);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  normal[nearest] = std::copysign(1.0, offset[nearest]);
  return {depth, normal};
}

SurfaceDistance distance_from(CylinderSolid const& cylinder, Eigen::Vector3d const& point) {
  double const from_axis = std::hypot(point.x(), point.y());
  double const half = 0.5 * cylinder.height_m;
  Eigen::Vector3d const radial =
      from_axis > 0.0 ? Eigen::Vector3d(point.x() / from_axis, point.y() / from_axis, 0.0)
                      : Eigen::Vector3d::UnitX();
  Eigen::Vector3d const axial(0.0, 0.0, std::copysign(1.0, point.z() - half));
  // How far beyond the side and beyond the nearer end; negative within. Outside both, the nearest
  // point lies on the rim.
  double const beyond_side = from_axis - cylinder.radius_m;
  double const beyond_end = std::abs(point.z() - half) - half;
  double const side = std::max(beyond_side, 0.0);
  double const end = std::max(beyond_end, 0.0);
  double const distance = std::hypot(side, end);
  if (distance > 0.0) {
    return {distance, (side * radial + end * axial) / distance};
  }
  return beyond_side > beyond_end ? SurfaceDistance{beyond_side, radial}
                                  : SurfaceDistance{beyond_end, axial};
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
