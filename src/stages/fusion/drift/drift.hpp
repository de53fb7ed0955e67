#pragma once

#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"
#include "stages/fusion/drift/offsets.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

/// The correction of the poses that frames tell (BeliefState::T_world_told), after one more frame:
/// the last one, moved so that the frame's floor, walls and stuff lie where the belief has them.
///
/// Nonlinear least squares over the camera's pose, in the convention of boxplus: point to plane,
/// Tukey's weights, and a prior that holds on to the last correction, so that directions in which
/// the frame says nothing stay as they were. The last correction is kept where a frame shows
/// neither enough of the floor, nor two walls, nor a few things.
[[nodiscard]] Se3 tracked_drift(BeliefState const& belief, Segmentation const& segmentation,
                                DriftConfig const& config);

/// A step of Gauss and Newton: information * step = -gradient.
struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
};

/// Of half the sum of all squared offsets over their variances, by Tukey's weights, to first order
/// in the error of a camera's pose. A surface counts as a few dozen blocks at most, however many it
/// has: blocks of one surface err together.
[[nodiscard]] NormalEquations normal_equations(std::vector<SurfaceOffsets> const& surfaces,
                                               Eigen::Vector3d const& camera_world,
                                               double most_sigmas);

}  // namespace credo
