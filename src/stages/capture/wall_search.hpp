#pragma once

#include <optional>
#include <span>

#include "core/plane.hpp"
#include "geometry/plane_search.hpp"

namespace credo {

/// The most prominent wall in the frames of a camera that stands still, given its floor (normal
/// up): of all planes that
///  - stand upright on the floor, within 6 degrees,
///  - have next to nothing behind them: the front of a cabinet has the wall,
///  - are at least half a metre wide and show half a square metre,
/// the one that shows the largest area, in cells of 10 cm that hold a point. Camera frame, normal
/// towards the camera. None where there is no such plane.
std::optional<Plane> find_wall(std::span<PlaneSearchPoints const> frames,
                               Plane const& floor_camera);

}  // namespace credo
