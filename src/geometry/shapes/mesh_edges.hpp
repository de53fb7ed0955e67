#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/object_model.hpp"

namespace credo {

/// An edge of a mesh and the triangles on it: `left` runs from `begin` to `end`, `right` from `end`
/// to `begin`. One of them is missing on a border.
struct MeshEdge {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::optional<std::uint32_t> left;
  std::optional<std::uint32_t> right;
};

/// All edges, in order of their vertices (begin < end); one that more than two triangles share
/// comes more than once. Vertices are the same only by index.
[[nodiscard]] std::vector<MeshEdge> edges_of(TriangleMesh const& mesh);

/// Every edge has one triangle on either side: the mesh has an inside.
[[nodiscard]] bool is_closed(std::vector<MeshEdge> const& edges);

/// (p1 - p0) x (p2 - p0): along the outward normal, twice the area long.
[[nodiscard]] Eigen::Vector3d area_vector(TriangleMesh const& mesh, std::size_t triangle);

}  // namespace credo
