#pragma once

#include <vector>

#include "core/grid.hpp"
#include "core/label.hpp"
#include "stages/clustering/stuff_runs.hpp"

namespace credo {

/// All pixels of stuff, and which of them hold together. Beside a jump a sensor takes now one
/// side's depth and now the other's, and slivers of what is behind are too small for segments of
/// their own; a segment takes such pixels in, but a single one of them at the far side would
/// stretch a bottle's bounds across the room.
///
/// Neighbours hold together where they have one label and nearly one inverse depth (kFirm_per_m);
/// what holds together is firm if it has a tenth of the pixels of its label's largest piece. Depth
/// in metres, positive where there is stuff; both grids have one size.
[[nodiscard]] std::vector<StuffRun> firm_runs(Grid<float> const& depth_m, LabelMap const& labels);

/// About nine standard deviations of a Kinect.
inline constexpr float kFirm_per_m = 0.026F;

}  // namespace credo
