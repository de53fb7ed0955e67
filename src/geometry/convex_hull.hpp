#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace credo {

/// A triangle of a convex hull: positions of its corners in the points, counter-clockwise seen from
/// outside.
using HullFace = std::array<std::uint32_t, 3>;

/// The convex hull of points in space, one point after the other, each against every face so far.
/// Points are first shaken by a fixed pattern of a millionth of their extent, so that four of them
/// are never in one plane: a flat side comes out as triangles that differ by so little. Empty for
/// fewer than four points, or for points that all lie within that much of one plane.
[[nodiscard]] std::vector<HullFace> convex_hull(std::vector<Eigen::Vector3d> const& points);

/// The corners of the convex hull of points in a plane, counter-clockwise (monotone chains, Andrew
/// 1979). Points on its sides are left out. Fewer than three where all points are in one line.
[[nodiscard]] std::vector<Eigen::Vector2d> convex_polygon(std::vector<Eigen::Vector2d> points);

/// How far inside a convex polygon, counter-clockwise, a point is: the distance to the nearest
/// line of a side, negative outside. Minus infinity for fewer than three corners.
[[nodiscard]] double depth_inside(std::vector<Eigen::Vector2d> const& polygon,
                                  Eigen::Vector2d const& point);

}  // namespace credo
