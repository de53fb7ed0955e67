#pragma once

#include "stages/planes/plane_view.hpp"

namespace credo {

/// Thesis 3.2: vertical, with nearly nothing beyond it. Where the config says `behind`, what lies
/// behind it may also be seen through openings or round a corner (`WallStrips`).
[[nodiscard]] bool is_wall(PlaneView const& view, PixelPlane const& plane);

}  // namespace credo
