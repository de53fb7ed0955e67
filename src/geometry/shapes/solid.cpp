#include "geometry/shapes/solid.hpp"

#include <cmath>
#include <limits>

namespace credo {
namespace {

/// The part of a ray's line that lies in all the regions it was cut with.
struct Crossing {
  RayEntry in = {-std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitZ()};
  double out = std::numeric_limits<double>::infinity();

  [[nodiscard]] std::optional<RayEntry> entry() const {
    return in.distance >= 0.0 && in.distance <= out ? std::optional(in) : std::nullopt;
  }
};

/// Cuts with low <= p[axis] <= high. A ray that runs along a face divides 0 by 0, and the
/// comparisons pass over the NaN.
void cut_with_slab(double low, double high, Eigen::Index axis, Eigen::Vector3d const& origin,
                   Eigen::Vector3d const& direction, Crossing& crossing) {
  bool const rising = direction[axis] >= 0.0;
  double const in = ((rising ? low : high) - origin[axis]) / direction[axis];
  double const out = ((rising ? high : low) - origin[axis]) / direction[axis];
  if (in > crossing.in.distance) {
    crossing.in = {in, (rising ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis)};
  }
  if (out < crossing.out) {
    crossing.out = out;
  }
}

/// Cuts with |p| <= radius, where origin and direction are seen from the centre or, flattened,
/// along the axis of a tube. From the closest approach, so that a far origin costs no digits.
void cut_with_round(double radius, Eigen::Vector3d const& origin, Eigen::Vector3d const& direction,
                    Crossing& crossing) {
  double const length2 = direction.squaredNorm();
  double const closest = length2 > 0.0 ? -origin.dot(direction) / length2 : 0.0;
  double const depth2 = radius * radius - (origin + closest * direction).squaredNorm();
  if (!(depth2 >= 0.0)) {
    crossing.out = -std::numeric_limits<double>::infinity();
  } else if (length2 > 0.0) {
    double const half = std::sqrt(depth2 / length2);
    double const in = closest - half;
    crossing.in = {in, (origin + in * direction).normalized()};
    crossing.out = closest + half;
  }
}

Crossing cross(BoxSolid const& box, Eigen::Vector3d const& origin,
               Eigen::Vector3d const& direction) {
  Crossing crossing;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    cut_with_slab(box.low_m[axis], box.high_m[axis], axis, origin, direction, crossing);
  }
  return crossing;
}

Crossing cross(CylinderSolid const& cylinder, Eigen::Vector3d const& origin,
               Eigen::Vector3d const& direction) {
  Crossing crossing;
  cut_with_round(cylinder.radius_m, {origin.x(), origin.y(), 0.0},
                 {direction.x(), direction.y(), 0.0}, crossing);
  cut_with_slab(0.0, cylinder.height_m, 2, origin, direction, crossing);
  return crossing;
}

Crossing cross(SphereSolid const& sphere, Eigen::Vector3d const& origin,
               Eigen::Vector3d const& direction) {
  Crossing crossing;
  cut_with_round(sphere.radius_m, origin - Eigen::Vector3d(0, 0, sphere.radius_m), direction,
                 crossing);
  return crossing;
}

Eigen::AlignedBox3d bounds(BoxSolid const& box) {
  return {box.low_m, box.high_m};
}

Eigen::AlignedBox3d bounds(CylinderSolid const& cylinder) {
  double const r = cylinder.radius_m;
  return {Eigen::Vector3d(-r, -r, 0), Eigen::Vector3d(r, r, cylinder.height_m)};
}

Eigen::AlignedBox3d bounds(SphereSolid const& sphere) {
  double const r = sphere.radius_m;
  return {Eigen::Vector3d(-r, -r, 0), Eigen::Vector3d(r, r, 2 * r)};
}

}  // namespace

Eigen::AlignedBox3d bounds_of(Solid const& solid) {
  return std::visit([](auto const& body) { return bounds(body); }, solid);
}

std::optional<RayEntry> enter(Solid const& solid, Eigen::Vector3d const& origin,
                              Eigen::Vector3d const& direction) {
  return std::visit([&](auto const& body) { return cross(body, origin, direction); }, solid)
      .entry();
}

}  // namespace credo
