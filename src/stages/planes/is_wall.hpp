#pragma once

#include "stages/planes/plane_view.hpp"

namespace credo {

/// Thesis 3.2: vertical, with nearly nothing beyond it.
[[nodiscard]] bool is_wall(PlaneView const& view, PixelPlane const& plane);

}  // namespace credo
