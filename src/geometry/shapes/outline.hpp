#pragma once

#include <vector>

#include "core/object_model.hpp"
#include "core/outline.hpp"

namespace credo {

/// A closed mesh of a solid, in its frame: exact for boxes, the round ones with 32 sides.
[[nodiscard]] TriangleMesh mesh_of(Solid const& solid);

/// What to draw of a model. Edges are sharp where their faces turn by more than 0.6 rad, or on a
/// border.
[[nodiscard]] std::vector<OutlineEdge> outline_of(ObjectModel const& model);

[[nodiscard]] Outlines outlines_of(ObjectModels const& models);

}  // namespace credo
