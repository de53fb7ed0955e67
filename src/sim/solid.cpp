#include "sim/solid.hpp"

#include <cmath>
#include <limits>
#include <numbers>

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

std::vector<Solid> table_solids(std::vector<double> const& size_m) {
  double const x = 0.5 * size_m[0];
  double const y = 0.5 * size_m[1];
  double const height = size_m[2];
  double const underside = height - size_m[3];
  double const leg = size_m[4];
  std::vector<Solid> solids = {BoxSolid{{-x, -y, underside}, {x, y, height}}};
  for (double const leg_x : {-x, x - leg}) {
    for (double const leg_y : {-y, y - leg}) {
      solids.emplace_back(BoxSolid{{leg_x, leg_y, 0}, {leg_x + leg, leg_y + leg, underside}});
    }
  }
  return solids;
}

}  // namespace

std::vector<Solid> solids_of(SceneThing const& thing) {
  std::vector<double> const& s = thing.size_m;
  switch (thing.shape) {
    case SceneShape::kBox:
      return {BoxSolid{{-0.5 * s[0], -0.5 * s[1], 0}, {0.5 * s[0], 0.5 * s[1], s[2]}}};
    case SceneShape::kCylinder:
      return {CylinderSolid{s[0], s[1]}};
    case SceneShape::kSphere:
      return {SphereSolid{s[0]}};
    case SceneShape::kTable:
      return table_solids(s);
  }
  return {};
}

Se3 pose_of(SceneThing const& thing) {
  Eigen::Vector3d const turn_rad =
      Eigen::Vector3d(thing.rpy_deg[0], thing.rpy_deg[1], thing.rpy_deg[2]) *
      (std::numbers::pi / 180.0);
  Eigen::Quaterniond const rotation =
      so3_exp({0, 0, turn_rad.z()}) * so3_exp({0, turn_rad.y(), 0}) * so3_exp({turn_rad.x(), 0, 0});
  return {rotation, {thing.position_m[0], thing.position_m[1], thing.position_m[2]}};
}

Eigen::AlignedBox3d bounds_of(Solid const& solid) {
  return std::visit([](auto const& body) { return bounds(body); }, solid);
}

std::optional<RayEntry> enter(Solid const& solid, Eigen::Vector3d const& origin,
                              Eigen::Vector3d const& direction) {
  return std::visit([&](auto const& body) { return cross(body, origin, direction); }, solid)
      .entry();
}

}  // namespace credo
