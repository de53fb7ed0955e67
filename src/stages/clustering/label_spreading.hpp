#pragma once

#include "core/cloud.hpp"
#include "core/label.hpp"

namespace credo {

/// Labels for pixels that no angle test could place: a pixel that is kUnassigned and has no normal
/// takes the label of that of its eight neighbours which lies nearest in space, if that is within
/// `radius_m`; of equally near ones, the first in raster order. Neighbours without depth or
/// unassigned have nothing to give. All pixels look at the same moment, `max_steps` times: labels
/// spread by so many pixels, whatever the order of the scan.
///
/// All three grids have the same size.
[[nodiscard]] LabelMap spread_labels(OrganizedCloud const& cloud, NormalMap const& normals,
                                     LabelMap labels, float radius_m, int max_steps);

}  // namespace credo
