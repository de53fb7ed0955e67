#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/se3.hpp"
#include "core/solid.hpp"

namespace credo {

/// Triangles over shared vertices, metres, in the model's frame; each turns counter-clockwise seen
/// from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A line in the model's frame about which turns by any angle change nothing.
struct SymmetryAxis {
  /// Unit.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  /// Turned end for end about the point it is the same, too, as a can is about its middle.
  bool both_ways = false;
};

/// The half turn about the axis' point, across the axis.
[[nodiscard]] inline Se3 end_for_end(SymmetryAxis const& axis) {
  Eigen::Quaterniond const turn(
      Eigen::AngleAxisd(std::numbers::pi, axis.direction.unitOrthogonal()));
  return {turn, axis.point_m - turn * axis.point_m};
}

/// The motions of a model that leave it as it was: turns about an axis, or some rotations about the
/// model's origin (the identity goes without saying), or none. Never both.
struct Symmetry {
  std::optional<SymmetryAxis> axis;
  std::vector<Eigen::Quaterniond> rotations;
};

/// What a type of known object looks like. Its frame: a primitive stands on the centre of its base,
/// z up; a mesh keeps its own.
struct ObjectModel {
  std::string name;
  /// A union of convex bodies, or a mesh; neither is empty.
  std::variant<std::vector<Solid>, TriangleMesh> shape;
  Symmetry symmetry;
  /// Of an open mesh: its triangles are seen from their outside alone, as those of an object of
  /// which only that side was ever seen. Else from both, as a sheet is.
  bool one_sided = false;
};

/// By name, which is what objects call their type.
using ObjectModels = std::map<std::string, ObjectModel>;

}  // namespace credo
