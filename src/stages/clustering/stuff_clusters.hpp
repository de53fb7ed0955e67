#pragma once

#include <span>
#include <vector>

#include "core/cloud.hpp"
#include "core/label.hpp"
#include "core/se3.hpp"
#include "core/segmentation.hpp"
#include "stages/clustering/stuff_runs.hpp"

namespace credo {

/// All pixels of stuff, as firm.
[[nodiscard]] std::vector<StuffRun> stuff_runs(LabelMap const& labels);

/// What each label of stuff in the image stands for: entry i tells of the pixels labelled
/// kFirstStuff + i, up to the greatest label there is; its points are thinned to the sampling's
/// spacing. A label that no pixel has gives an entry without pixels and points.
///
/// Centroid, bounds and points are those of pixels that are firm, as many as the sampling wants
/// (sampled_cells); the pixel count is of all.
///
/// `cloud` is in the camera frame; `runs` are in raster order, and their pixels have finite points.
/// The order of all sums is that of the raster: the result depends on nothing but the input.
[[nodiscard]] std::vector<StuffCluster> stuff_clusters(OrganizedCloud const& cloud,
                                                       std::span<StuffRun const> runs,
                                                       PixelSampling const& sampling,
                                                       Se3 const& T_world_camera);

}  // namespace credo
