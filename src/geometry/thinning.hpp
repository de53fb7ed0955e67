#pragma once

#include <Eigen/Core>
#include <span>

#include "core/segmentation.hpp"

namespace credo {

// Both functions lay a grid of cubes of edge `spacing_m` over the frame of the points, aligned with
// its axes and with a corner at the origin. Points that are not finite are skipped. Beyond 2^20
// cells from the origin along an axis, cells are no longer told apart. A spacing that is not
// positive and finite throws std::logic_error.

/// One point per occupied cell: the mean of the points in it. Ordered by the first point of each
/// cell, so that the result depends on the order of the input alone. Points that are thinned
/// already come back as they are.
[[nodiscard]] PointList thin_points(std::span<Eigen::Vector3f const> points, float spacing_m);

/// The union of two point sets, grown on a grid: `known`, unchanged and first, then one mean point
/// per cell that only `added` occupies, in the order of `added`. The known points need not be
/// thinned.
[[nodiscard]] PointList merged_points(PointList const& known, PointList const& added,
                                      float spacing_m);

}  // namespace credo
