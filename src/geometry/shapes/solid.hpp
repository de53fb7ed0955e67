#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "core/solid.hpp"

namespace credo {

/// The smallest box around a solid, in its own frame.
Eigen::AlignedBox3d bounds_of(Solid const& solid);

/// Where a ray comes into a solid: origin + distance * direction, and the unit normal there,
/// outward.
struct RayEntry {
  double distance = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// Where a ray from outside comes into a solid, all in the frame of its thing; a convex body is
/// where its slabs and its tube meet, so it is entered where the last of them is (Kay and Kajiya
/// 1986). None where the ray misses, and none from inside. The direction may have any length but
/// zero.
std::optional<RayEntry> enter(Solid const& solid, Eigen::Vector3d const& origin,
                              Eigen::Vector3d const& direction);

}  // namespace credo
