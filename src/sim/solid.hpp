#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <variant>
#include <vector>

#include "core/se3.hpp"
#include "sim/scene.hpp"

namespace credo {

/// Axis-aligned in its thing's frame.
struct BoxSolid {
  Eigen::Vector3d low_m;
  Eigen::Vector3d high_m;
};

/// Upright, from z = 0 to its height.
struct CylinderSolid {
  double radius_m;
  double height_m;
};

/// Resting on z = 0.
struct SphereSolid {
  double radius_m;
};

/// A convex body in its thing's frame.
using Solid = std::variant<BoxSolid, CylinderSolid, SphereSolid>;

/// The bodies that a thing is made of: one, or five for a table (its top, then its legs). The thing
/// must have passed check_scene.
std::vector<Solid> solids_of(SceneThing const& thing);

/// T_world_thing.
Se3 pose_of(SceneThing const& thing);

/// The smallest box around a solid, in its thing's frame.
Eigen::AlignedBox3d bounds_of(Solid const& solid);

/// Where a ray comes into a solid: origin + distance * direction, and the unit normal there,
/// outward.
struct RayEntry {
  double distance = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// Where a ray from outside comes into a solid, all in the thing's frame; a convex body is where
/// its slabs and its tube meet, so it is entered where the last of them is (Kay and Kajiya 1986).
/// None where the ray misses, and none from inside. The direction may have any length but zero.
std::optional<RayEntry> enter(Solid const& solid, Eigen::Vector3d const& origin,
                              Eigen::Vector3d const& direction);

}  // namespace credo
