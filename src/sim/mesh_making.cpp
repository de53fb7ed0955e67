#include "sim/mesh_making.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>

namespace credo {
namespace {

/// A turn is so many faces: at 15 cm they are off the circle by less than half a millimetre.
constexpr std::uint32_t kSides = 48;
constexpr std::uint32_t kBarSides = 12;

void check_count(std::size_t count, std::size_t least, char const* what) {
  if (count < least) {
    throw std::logic_error(std::string(what) + ": too few points");
  }
}

/// Joins ring after ring of equally many vertices; each turns counter-clockwise seen from where
/// the rings go.
void add_sleeve(TriangleMesh& mesh, std::uint32_t first, std::uint32_t sides,
                std::uint32_t ring_count) {
  for (std::uint32_t ring = 0; ring + 1 < ring_count; ++ring) {
    std::uint32_t const low = first + ring * sides;
    std::uint32_t const high = low + sides;
    for (std::uint32_t i = 0; i < sides; ++i) {
      std::uint32_t const next = (i + 1) % sides;
      mesh.triangles.push_back({low + i, low + next, high + next});
      mesh.triangles.push_back({low + i, high + next, high + i});
    }
  }
}

/// Closes a ring to a point; `outward` where the ring turns counter-clockwise seen from outside.
void add_cap(TriangleMesh& mesh, std::uint32_t ring, std::uint32_t sides, std::uint32_t tip,
             bool outward) {
  for (std::uint32_t i = 0; i < sides; ++i) {
    std::uint32_t const a = ring + i;
    std::uint32_t const b = ring + (i + 1) % sides;
    mesh.triangles.push_back(outward ? std::array{a, b, tip} : std::array{b, a, tip});
  }
}

Eigen::Vector3f ring_point(Eigen::Vector2d const& outline, std::uint32_t side) {
  double const angle = 2.0 * std::numbers::pi * side / kSides;
  return Eigen::Vector3d(outline.x() * std::cos(angle), outline.x() * std::sin(angle), outline.y())
      .cast<float>();
}

}  // namespace

TriangleMesh revolved(std::vector<Eigen::Vector2d> const& outline) {
  check_count(outline.size(), 3, "revolved");
  TriangleMesh mesh;
  auto const rings = static_cast<std::uint32_t>(outline.size() - 2);
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      mesh.vertices.push_back(ring_point(outline[ring + 1], side));
    }
  }
  std::uint32_t const below = rings * kSides;
  mesh.vertices.push_back(ring_point(outline.front(), 0));
  mesh.vertices.push_back(ring_point(outline.back(), 0));
  add_sleeve(mesh, 0, kSides, rings);
  add_cap(mesh, 0, kSides, below, false);
  add_cap(mesh, (rings - 1) * kSides, kSides, below + 1, true);
  return mesh;
}

TriangleMesh prism(std::vector<Eigen::Vector2d> const& polygon, double low_m, double high_m) {
  check_count(polygon.size(), 3, "prism");
  TriangleMesh mesh;
  auto const sides = static_cast<std::uint32_t>(polygon.size());
  for (double const z : {low_m, high_m}) {
    for (Eigen::Vector2d const& corner : polygon) {
      mesh.vertices.push_back(Eigen::Vector3d(corner.x(), corner.y(), z).cast<float>());
    }
  }
  add_sleeve(mesh, 0, sides, 2);
  for (std::uint32_t i = 1; i + 1 < sides; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({sides, sides + i, sides + i + 1});
  }
  return mesh;
}

TriangleMesh block(Eigen::Vector3d const& size_m) {
  Eigen::Vector3d const half = 0.5 * size_m;
  return prism(
      {{-half.x(), -half.y()}, {half.x(), -half.y()}, {half.x(), half.y()}, {-half.x(), half.y()}},
      -half.z(), half.z());
}

TriangleMesh bar(std::vector<Eigen::Vector3d> const& path, double radius_m) {
  check_count(path.size(), 2, "bar");
  TriangleMesh mesh;
  Eigen::Vector3d side = (path[1] - path[0]).unitOrthogonal();
  for (std::size_t i = 0; i < path.size(); ++i) {
    Eigen::Vector3d const along =
        (path[std::min(i + 1, path.size() - 1)] - path[i == 0 ? 0 : i - 1]).normalized();
    // Carried along the path: the rings do not twist.
    side = (side - side.dot(along) * along).normalized();
    Eigen::Vector3d const up = along.cross(side);
    for (std::uint32_t k = 0; k < kBarSides; ++k) {
      double const angle = 2.0 * std::numbers::pi * k / kBarSides;
      mesh.vertices.push_back(
          (path[i] + radius_m * (std::cos(angle) * side + std::sin(angle) * up)).cast<float>());
    }
  }
  auto const rings = static_cast<std::uint32_t>(path.size());
  mesh.vertices.push_back(path.front().cast<float>());
  mesh.vertices.push_back(path.back().cast<float>());
  add_sleeve(mesh, 0, kBarSides, rings);
  add_cap(mesh, 0, kBarSides, rings * kBarSides, false);
  add_cap(mesh, (rings - 1) * kBarSides, kBarSides, rings * kBarSides + 1, true);
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, Se3 const& pose) {
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    vertex = (pose * vertex.cast<double>()).cast<float>();
  }
  return mesh;
}

TriangleMesh joined(std::vector<TriangleMesh> const& parts) {
  TriangleMesh whole;
  for (TriangleMesh const& part : parts) {
    auto const first = static_cast<std::uint32_t>(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (auto const& [a, b, c] : part.triangles) {
      whole.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return whole;
}

TriangleMesh centred(TriangleMesh mesh) {
  Eigen::AlignedBox3f box;
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    box.extend(vertex);
  }
  Eigen::Vector3f const middle = box.center();
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    vertex -= middle;
  }
  return mesh;
}

}  // namespace credo
