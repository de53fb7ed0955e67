#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/object_model.hpp"
#include "core/se3.hpp"

namespace credo {

// Closed meshes made of a few numbers, metres. All throw std::logic_error for too few points.

/// The body that an outline makes when it turns about z. `outline` is (radius, z), from the axis
/// below, around the outside and back to the axis; its first and last radius are 0 and no other.
[[nodiscard]] TriangleMesh revolved(std::vector<Eigen::Vector2d> const& outline);

/// A convex polygon (x, y), counter-clockwise seen from +z, drawn out from z = low to z = high.
[[nodiscard]] TriangleMesh prism(std::vector<Eigen::Vector2d> const& polygon, double low_m,
                                 double high_m);

/// A box about the origin.
[[nodiscard]] TriangleMesh block(Eigen::Vector3d const& size_m);

/// A bent round bar along a path without sharp turns, with flat ends.
[[nodiscard]] TriangleMesh bar(std::vector<Eigen::Vector3d> const& path, double radius_m);

[[nodiscard]] TriangleMesh moved(TriangleMesh mesh, Se3 const& pose);
/// Side by side in one mesh. Where parts run into each other their faces stay.
[[nodiscard]] TriangleMesh joined(std::vector<TriangleMesh> const& parts);
/// Moved so that the middle of the box around it is the origin.
[[nodiscard]] TriangleMesh centred(TriangleMesh mesh);

}  // namespace credo
