#include "geometry/shapes/outline.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "geometry/shapes/mesh_edges.hpp"

namespace credo {
namespace {

constexpr std::uint32_t kSides = 32;
constexpr double kSharp_rad = 0.6;

TriangleMesh mesh_from(BoxSolid const& box) {
  TriangleMesh mesh;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    auto const pick = [&](Eigen::Index axis) {
      return (corner >> axis & 1U) != 0 ? box.high_m[axis] : box.low_m[axis];
    };
    mesh.vertices.emplace_back(Eigen::Vector3d(pick(0), pick(1), pick(2)).cast<float>());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A ring of radius and height.
struct Ring {
  double radius_m;
  double height_m;
};

/// Turned about z: from a point at the bottom over rings, upward, to a point at the top.
TriangleMesh lathed(double bottom_m, std::vector<Ring> const& rings, double top_m) {
  TriangleMesh mesh;
  mesh.vertices.emplace_back(Eigen::Vector3d(0, 0, bottom_m).cast<float>());
  for (Ring const& ring : rings) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      double const angle = 2.0 * std::numbers::pi * side / kSides;
      mesh.vertices.emplace_back(Eigen::Vector3d(ring.radius_m * std::cos(angle),
                                                 ring.radius_m * std::sin(angle), ring.height_m)
                                     .cast<float>());
    }
  }
  mesh.vertices.emplace_back(Eigen::Vector3d(0, 0, top_m).cast<float>());
  auto const last = static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
  for (std::uint32_t side = 0; side < kSides; ++side) {
    std::uint32_t const next = (side + 1) % kSides;
    mesh.triangles.push_back({0, 1 + next, 1 + side});
    for (std::uint32_t base = 1; base + 2 * kSides <= last; base += kSides) {
      mesh.triangles.push_back({base + side, base + next, base + kSides + side});
      mesh.triangles.push_back({base + next, base + kSides + next, base + kSides + side});
    }
    mesh.triangles.push_back({last, last - kSides + side, last - kSides + next});
  }
  return mesh;
}

TriangleMesh mesh_from(CylinderSolid const& cylinder) {
  double const r = cylinder.radius_m;
  return lathed(0.0, {{r, 0.0}, {r, cylinder.height_m}}, cylinder.height_m);
}

TriangleMesh mesh_from(SphereSolid const& sphere) {
  std::vector<Ring> rings;
  for (std::uint32_t k = 1; k < kSides / 2; ++k) {
    double const angle = 2.0 * std::numbers::pi * k / kSides;
    rings.push_back({sphere.radius_m * std::sin(angle), sphere.radius_m * (1.0 - std::cos(angle))});
  }
  return lathed(0.0, rings, 2.0 * sphere.radius_m);
}

void add_outline(TriangleMesh const& mesh, std::vector<OutlineEdge>& outline) {
  for (MeshEdge const& edge : edges_of(mesh)) {
    OutlineEdge drawn{mesh.vertices[edge.begin], mesh.vertices[edge.end]};
    drawn.sharp = !edge.left || !edge.right;
    if (!drawn.sharp) {
      Eigen::Vector3d const left = area_vector(mesh, *edge.left);
      Eigen::Vector3d const right = area_vector(mesh, *edge.right);
      drawn.sharp = std::atan2(left.cross(right).norm(), left.dot(right)) > kSharp_rad;
      drawn.normal_left = left.cast<float>();
      drawn.normal_right = right.cast<float>();
    }
    // Between two triangles of one plane there is nothing to draw from anywhere.
    if (drawn.sharp || drawn.normal_left.cross(drawn.normal_right).norm() >
                           1e-5F * drawn.normal_left.norm() * drawn.normal_right.norm()) {
      outline.push_back(drawn);
    }
  }
}

}  // namespace

TriangleMesh mesh_of(Solid const& solid) {
  return std::visit([](auto const& body) { return mesh_from(body); }, solid);
}

std::vector<OutlineEdge> outline_of(ObjectModel const& model) {
  std::vector<OutlineEdge> outline;
  if (auto const* mesh = std::get_if<TriangleMesh>(&model.shape)) {
    add_outline(*mesh, outline);
    return outline;
  }
  for (Solid const& solid : std::get<std::vector<Solid>>(model.shape)) {
    add_outline(mesh_of(solid), outline);
  }
  return outline;
}

Outlines outlines_of(ObjectModels const& models) {
  Outlines outlines;
  for (auto const& [name, model] : models) {
    outlines.emplace(name, outline_of(model));
  }
  return outlines;
}

}  // namespace credo
