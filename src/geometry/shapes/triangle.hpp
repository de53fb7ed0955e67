#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace credo {

/// The part of a triangle that a point is nearest to. Edge i runs from corner i to corner i + 1.
enum class TrianglePart : std::uint8_t {
  kFace,
  kEdge0,
  kEdge1,
  kEdge2,
  kCorner0,
  kCorner1,
  kCorner2,
};

struct NearestOnTriangle {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  TrianglePart part = TrianglePart::kFace;
};

/// The point of a triangle that is nearest to `point`. The triangle must have an area.
[[nodiscard]] NearestOnTriangle nearest_on_triangle(std::array<Eigen::Vector3d, 3> const& corners,
                                                    Eigen::Vector3d const& point);

/// Where a ray meets a triangle, from either side: at origin + distance * direction. None where it
/// misses, or runs along the triangle. Of two triangles that share an edge, a ray through the edge
/// meets one at least: no gap opens between them.
[[nodiscard]] std::optional<double> distance_to_triangle(
    std::array<Eigen::Vector3d, 3> const& corners, Eigen::Vector3d const& origin,
    Eigen::Vector3d const& direction);

}  // namespace credo
