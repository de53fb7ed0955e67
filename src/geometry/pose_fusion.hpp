#pragma once

#include "core/object_model.hpp"
#include "core/se3.hpp"

namespace credo {

/// How a detected pose lies to an expected one.
struct PoseMatch {
  /// Squared Mahalanobis distance under the sum of both covariances, least over the model's
  /// symmetry.
  double squared_distance = 0.0;
  /// Of the chi-square distribution that it follows if both are about the same pose: 6, or 5 where
  /// turns about an axis cannot be told.
  int degrees_of_freedom = 6;
  /// The pose that looks just like the detected one and is nearest to the expected one.
  Se3 equivalent;
};

/// Expected and detected pose of one model, in one frame, their errors independent. Covariances
/// must be positive definite; throws std::logic_error where their sum is not.
///
/// Errors are compared as (shift of the symmetry axis' point or the model's origin, turn about the
/// model's axes): in these coordinates a turn about the symmetry axis is one fixed direction,
/// whatever the pose, and is left out.
[[nodiscard]] PoseMatch match_pose(PoseDistribution const& expected,
                                   PoseDistribution const& detected, Symmetry const& symmetry);

/// The expected pose after the detection (Kalman's update in information form, error state in the
/// tangent space; thesis algorithm 4). `weight` in (0, 1] is the part of the detection that is
/// news: its information counts so much.
///
/// About a symmetry axis nothing is learnt, ever: the information about that turn stays what it
/// was, to rounding, after any number of updates.
[[nodiscard]] PoseDistribution updated_pose(PoseDistribution const& expected,
                                            PoseDistribution const& detected,
                                            Symmetry const& symmetry, double weight = 1.0);

}  // namespace credo
