#pragma once

#include <vector>

#include "core/object_model.hpp"
#include "geometry/shapes/seen_points.hpp"

namespace credo {

/// A mesh of what cameras saw of an object, in the frame of the points; open where nobody looked.
struct LearnedSurface {
  TriangleMesh mesh;
  /// Edge of the grid that it was made on.
  float spacing_m = 0.0F;
  /// All that was seen, and those of it that have a normal and made the mesh.
  std::size_t points = 0;
  std::size_t used_points = 0;
};

/// Normals of each view's points (seen_points.hpp), and the surface through those of all views
/// (surface_nets.hpp), on a grid of 3 mm, or of 1/120 of the longest side, or of one and a half
/// times the points' pitch, whichever is the coarsest. The mesh is empty where there are no or too
/// few points. What is not in a view is taken for unseen, not for empty.
[[nodiscard]] LearnedSurface learned_surface(std::vector<SeenPoints> const& views);

}  // namespace credo
