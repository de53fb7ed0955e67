#pragma once

#include <cstddef>
#include <filesystem>

#include "core/model_file.hpp"
#include "core/object_model.hpp"

namespace credo {

/// A mesh as a file holds it.
struct LoadedMesh {
  TriangleMesh mesh;
  /// Edges that do not have exactly two triangles turning opposite ways along them; 0 = closed.
  std::size_t boundary_edges = 0;
};

/// Reads a mesh in any format that assimp knows: PLY, OBJ, STL, glTF, Collada and more. All meshes
/// of the scene are joined, each placed by its nodes and in metres; vertices at the same position
/// become one; polygons become triangles; triangles of no area (to the rounding of floats), points,
/// lines and vertices of no triangle are left out. A closed mesh that is inside out is turned, so
/// that its triangles turn counter-clockwise seen from outside; an open one stays as it is.
///
/// Throws InputError for a file that cannot be read or is damaged, for no triangles, for a vertex
/// that is not finite, and for a longest side above 20 m or below 1 mm, which is most often the
/// wrong unit. Text formats but PLY do not say how much they hold: one that is cut between two of
/// its faces passes as an open mesh.
LoadedMesh read_mesh(std::filesystem::path const& path, LengthUnit unit);

}  // namespace credo
