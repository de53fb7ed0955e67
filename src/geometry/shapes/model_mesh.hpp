#pragma once

#include "core/object_model.hpp"

namespace credo {

/// The surface of a model as triangles, in its frame: a mesh as it is, else that of each solid
/// (mesh_of in outline.hpp). Where solids overlap, parts of it lie inside.
[[nodiscard]] TriangleMesh mesh_of(ObjectModel const& model);

}  // namespace credo
