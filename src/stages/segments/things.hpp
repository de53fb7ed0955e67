#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/segments.hpp"

namespace credo {

/// A frame in things: `convex_segments`, then `split_by_color`, `join_parts`,
/// `with_raised_things` and `join_sides`, as far as `config` has them. `color` is registered, or
/// empty. `up_camera` is a unit vector in the camera frame, where it is known.
[[nodiscard]] Segments segment_things(Grid<float> const& depth_m, Grid<Rgb> const& color,
                                      CameraIntrinsics const& intrinsics,
                                      std::optional<Eigen::Vector3d> const& up_camera,
                                      SegmentsConfig const& config);

/// The same for a frame, whose colour counts as far as it is registered.
[[nodiscard]] Segments segment_things(Frame const& frame,
                                      std::optional<Eigen::Vector3d> const& up_camera,
                                      SegmentsConfig const& config);

}  // namespace credo
