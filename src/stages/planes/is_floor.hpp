#pragma once

#include "stages/planes/plane_view.hpp"

namespace credo {

/// Thesis 3.2: horizontal, and at z = 0.
[[nodiscard]] bool is_floor(PlaneView const& view, PixelPlane const& plane);

/// Those of the pixels that are near enough to z = 0 for a floor.
[[nodiscard]] CountedPixels low_pixels(PlaneView const& view, CountedPixels pixels);

}  // namespace credo
