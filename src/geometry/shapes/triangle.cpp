#include "geometry/shapes/triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace credo {
namespace {

constexpr std::array<TrianglePart, 3> kEdges = {TrianglePart::kEdge0, TrianglePart::kEdge1,
                                                TrianglePart::kEdge2};
constexpr std::array<TrianglePart, 3> kCorners = {TrianglePart::kCorner0, TrianglePart::kCorner1,
                                                  TrianglePart::kCorner2};

NearestOnTriangle nearest_on_edge(std::array<Eigen::Vector3d, 3> const& corners, std::size_t edge,
                                  Eigen::Vector3d const& point) {
  std::size_t const next = (edge + 1) % 3;
  Eigen::Vector3d const along = corners[next] - corners[edge];
  double const share = (point - corners[edge]).dot(along) / along.squaredNorm();
  if (share <= 0.0) {
    return {corners[edge], kCorners[edge]};
  }
  if (share >= 1.0) {
    return {corners[next], kCorners[next]};
  }
  return {corners[edge] + share * along, kEdges[edge]};
}

}  // namespace

NearestOnTriangle nearest_on_triangle(std::array<Eigen::Vector3d, 3> const& corners,
                                      Eigen::Vector3d const& point) {
  Eigen::Vector3d const normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  bool above_face = true;
  NearestOnTriangle nearest;
  double least = 0.0;
  // Beyond an edge's side the nearest point lies on the border, though not always on that edge.
  for (std::size_t edge = 0; edge < 3; ++edge) {
    Eigen::Vector3d const along = corners[(edge + 1) % 3] - corners[edge];
    if (normal.cross(along).dot(point - corners[edge]) >= 0.0) {
      continue;
    }
    NearestOnTriangle const candidate = nearest_on_edge(corners, edge, point);
    double const distance2 = (point - candidate.point).squaredNorm();
    if (above_face || distance2 < least) {
      nearest = candidate;
      least = distance2;
    }
    above_face = false;
  }
  if (above_face) {
    double const height = normal.dot(point - corners[0]) / normal.squaredNorm();
    nearest = {point - height * normal, TrianglePart::kFace};
  }
  return nearest;
}

std::optional<double> distance_to_triangle(std::array<Eigen::Vector3d, 3> const& corners,
                                           Eigen::Vector3d const& origin,
                                           Eigen::Vector3d const& direction) {
  std::array<Eigen::Vector3d, 3> const from_eye = {corners[0] - origin, corners[1] - origin,
                                                   corners[2] - origin};
  bool left = false;
  bool right = false;
  for (std::size_t edge = 0; edge < 3; ++edge) {
    // The edge as the neighbour runs along it gives this number with the other sign, exactly.
    double const side = direction.dot(from_eye[edge].cross(from_eye[(edge + 1) % 3]));
    left = left || side > 0.0;
    right = right || side < 0.0;
  }
  Eigen::Vector3d const normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  double const slope = normal.dot(direction);
  if ((left && right) || slope == 0.0) {
    return std::nullopt;
  }
  double const distance = normal.dot(from_eye[0]) / slope;
  return distance >= 0.0 ? std::optional(distance) : std::nullopt;
}

}  // namespace credo
