#pragma once

#include "core/frame.hpp"
#include "core/object_model.hpp"

namespace credo {

/// A mesh from six sides, along its axes, in one picture: above from +x, +y and +z, below from -x,
/// -y and -z, all to one scale. The outside of its triangles is grey, the brighter the more it
/// faces the viewer; their inside is red: that is where an open mesh ends, and nothing was seen.
/// A mesh without triangles gives an empty picture.
[[nodiscard]] Grid<Rgb> draw_model(TriangleMesh const& mesh);

}  // namespace credo
