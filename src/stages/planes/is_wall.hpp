#pragma once

#include <cstdint>
#include <vector>

#include "geometry/plane_search.hpp"
#include "stages/planes/plane_view.hpp"

namespace credo {

/// Thesis 3.2: vertical, with nearly nothing beyond it. Where the config says `behind`, what lies
/// behind it may also be seen through openings or round a corner (`WallStrips`).
[[nodiscard]] bool is_wall(PlaneView const& view, PixelPlane const& plane);

/// False for an upright plane that is clearly no wall, told without its pixels by a sample, each of
/// whose points stands for `pixels_each` pixels: those at the positions `shown` of what is left of
/// it lie in the plane, and any of all may be behind. True where those are too few to tell
/// (kEnoughShown), or where nothing on either side would do.
[[nodiscard]] bool may_be_wall(PlaneView const& view, PixelPlane const& plane,
                               std::vector<std::uint32_t> shown, PlaneSearchPoints const& left,
                               PlaneSearchPoints const& all, double pixels_each);

}  // namespace credo
