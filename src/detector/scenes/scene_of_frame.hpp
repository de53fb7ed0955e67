#pragma once

#include "core/frame.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

/// A frame made ready to be searched: its normals and segments as by default.
[[nodiscard]] SearchScene scene_of(Frame const& frame);

}  // namespace credo
