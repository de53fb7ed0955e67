#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/segments.hpp"

namespace credo {

/// Joins the parts of one thing that a crease or a jump of depth holds apart:
/// - the inside of a vessel and its outside: what lies behind nothing but one segment, no farther
///   than both are large, before something else (the rim's far side), and is hollow; where the
///   image's border cuts it off, other than at the top, it cuts off the outside, too. It touches
///   nothing else, or the outside at the ends of its rim. Where `up_camera` (unit vector, camera
///   frame) tells that the outside is level, as a table's top, it has no inside;
/// - what sticks out of one thing, is less than a quarter of it and touches nothing else: handle,
///   cap, neck. What stands on a level surface does not stick out of it, so without `up_camera`
///   none of these join; what does not rise above it is its rim.
///
/// A thing's foot shows whether it is one of its own, so what the image's border cuts off or what
/// something else hides a part of joins nothing; a thing whose foot is hidden by one that touches
/// nothing else is the mistake that is left.
///
/// `segments` are those of `convex_segments` for that depth; the result is numbered like them.
/// Empty images and images without segments are no error.
[[nodiscard]] Segments join_parts(Segments segments, Grid<float> const& depth_m,
                                  CameraIntrinsics const& intrinsics,
                                  std::optional<Eigen::Vector3d> const& up_camera,
                                  SegmentsConfig const& config);

}  // namespace credo
