#pragma once

#include <vector>

#include "core/cloud.hpp"
#include "core/label.hpp"
#include "core/se3.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// What each label of stuff in the image stands for: entry i tells of the pixels labelled
/// kFirstStuff + i, up to the greatest label there is; its points are thinned to `spacing_m`. A
/// label that no pixel has gives an entry without pixels and points.
///
/// Where `firm` is not empty, centroid, bounds and points are those of the pixels where it is not
/// 0, of which each label has one; the pixel count is of all.
///
/// `cloud` (camera frame) and `labels` have one size; pixels of stuff have finite points. The order
/// of all sums is that of the raster: the result depends on nothing but the input.
[[nodiscard]] std::vector<StuffCluster> stuff_clusters(OrganizedCloud const& cloud,
                                                       LabelMap const& labels,
                                                       Grid<std::uint8_t> const& firm,
                                                       Se3 const& T_world_camera, float spacing_m);

}  // namespace credo
