#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "core/label.hpp"

namespace credo {

/// 1 for pixels of stuff that lie with their neighbours, else 0. Beside a jump a sensor takes now
/// one side's depth and now the other's; a segment takes such pixels in, but a single one of them
/// at the far side would stretch a bottle's bounds across the room.
///
/// A pixel is firm where at least three of the eight around it have its label and nearly its
/// inverse depth (kFirm_per_m). Labels without a firm pixel have all of theirs. Depth in metres,
/// positive where there is stuff; both grids have one size.
[[nodiscard]] Grid<std::uint8_t> firm_pixels(Grid<float> const& depth_m, LabelMap const& labels);

/// About nine standard deviations of a Kinect.
inline constexpr float kFirm_per_m = 0.026F;

}  // namespace credo
