#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/segments.hpp"

namespace credo {

/// Joins the sides of things to their tops, which more than a crease parts from them: the box under
/// the rim of its lid, the leg under a seat. A side touches a level surface (one that faces
/// `up_camera`, unit vector, camera frame), is not level itself, is beneath that surface's plane,
/// does not reach out from under it, and is seen from beside it, not beyond its far edge. What lies
/// on something is neither a top nor a side. Without `up_camera` nothing joins.
///
/// So does what stands close under a level thing that lies on it and is larger, as two things that
/// touch so cannot be told from one.
///
/// Labels keep their order: what is joined has the lower one of both, those after it move up.
/// Depth in metres, as given to `convex_segments`. Empty images and images without segments are no
/// error.
[[nodiscard]] Segments join_sides(Segments segments, Grid<float> const& depth_m,
                                  CameraIntrinsics const& intrinsics,
                                  std::optional<Eigen::Vector3d> const& up_camera,
                                  SegmentsConfig const& config);

}  // namespace credo
