#include "geometry/shapes/mesh_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <compare>
#include <cstddef>

namespace credo {
namespace {

/// A triangle's side; `reversed` where it runs from the greater vertex to the lesser.
struct Side {
  std::uint32_t low;
  std::uint32_t high;
  bool reversed;
  std::uint32_t triangle;
  friend auto operator<=>(Side const&, Side const&) = default;
};

std::vector<Side> sides_of(TriangleMesh const& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t const a = mesh.triangles[t][k];
      std::uint32_t const b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a > b, static_cast<std::uint32_t>(t)});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

}  // namespace

std::vector<MeshEdge> edges_of(TriangleMesh const& mesh) {
  std::vector<Side> const sides = sides_of(mesh);
  std::vector<MeshEdge> edges;
  edges.reserve(sides.size() / 2 + 1);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    Side const& first = sides[begin];
    while (end < sides.size() && sides[end].low == first.low && sides[end].high == first.high) {
      ++end;
    }
    std::size_t turn = begin;  // the first of those that run the other way
    while (turn < end && !sides[turn].reversed) {
      ++turn;
    }
    for (std::size_t k = 0; begin + k < turn || turn + k < end; ++k) {
      MeshEdge edge{first.low, first.high, std::nullopt, std::nullopt};
      if (begin + k < turn) {
        edge.left = sides[begin + k].triangle;
      }
      if (turn + k < end) {
        edge.right = sides[turn + k].triangle;
      }
      edges.push_back(edge);
    }
  }
  return edges;
}

bool is_closed(std::vector<MeshEdge> const& edges) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    bool const shared_by_more =
        i > 0 && edges[i].begin == edges[i - 1].begin && edges[i].end == edges[i - 1].end;
    if (shared_by_more || !edges[i].left || !edges[i].right) {
      return false;
    }
  }
  return !edges.empty();
}

Eigen::Vector3d area_vector(TriangleMesh const& mesh, std::size_t triangle) {
  auto const corner = [&](std::size_t k) -> Eigen::Vector3d {
    return mesh.vertices[mesh.triangles[triangle][k]].cast<double>();
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

}  // namespace credo
