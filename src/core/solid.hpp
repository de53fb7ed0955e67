#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

namespace credo {

// Convex bodies in the frame of the thing that they are part of, metres.

/// Axis-aligned.
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

using Solid = std::variant<BoxSolid, CylinderSolid, SphereSolid>;

/// A box that stands on the centre of its base.
[[nodiscard]] BoxSolid box_on_base(Eigen::Vector3d const& size_m);

/// The measures of a table with four square legs under the corners of its top.
struct TableSize {
  Eigen::Vector2d top_m;
  /// From the floor to the upper side of the top.
  double height_m;
  double thickness_m;
  /// Side of a leg.
  double leg_m;
};

/// Its top, then its legs; it stands on the centre of its base.
[[nodiscard]] std::vector<Solid> table_on_base(TableSize const& size);

}  // namespace credo
