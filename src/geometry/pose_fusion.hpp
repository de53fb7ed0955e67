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
  /// Of the sum of both covariances, without what cannot be told. Among several expected poses the
  /// detected one is likeliest to be of that with the least squared_distance + log_determinant: a
  /// vague one is near to everything.
  double log_determinant = 0.0;
};

/// Expected and detected pose of one model, in one frame, their errors independent. Covariances
/// must be positive definite; throws std::logic_error where their sum is not.
///
/// Errors are compared as (shift of the symmetry axis' point or the model's origin, turn about the
/// model's axes): in these coordinates a turn about the symmetry axis is one fixed direction,
/// whatever the pose, and is left out.
[[nodiscard]] PoseMatch match_pose(PoseDistribution const& expected,
                                   PoseDistribution const& detected, Symmetry const& symmetry);

/// One deviation of the place of a point of the surface, `radius_m` from the origin of the pose,
/// along the direction in which it is known least, turn and shift taken at their largest. Turns
/// about the model's symmetry axis do not move the surface, however little is known of them.
[[nodiscard]] double largest_deviation_m(PoseDistribution const& pose, double radius_m,
                                         Symmetry const& symmetry);

/// How much of a detection to take.
struct PoseUpdate {
  /// In (0, 1]: the part of the detection that is news; its information counts so much.
  double weight = 1.0;
  /// In [0, 0.5]: the part of the detection's covariance that no number of looks takes away,
  /// because their errors have it in common. Information beyond is forgotten, direction by
  /// direction, before the news is added. 0: nothing is forgotten.
  double min_covariance_share = 0.0;
};

/// The expected pose after the detection (Kalman's update in information form, error state in the
/// tangent space; thesis algorithm 4). Throws std::logic_error for an update out of its ranges.
///
/// About a symmetry axis nothing is learnt, ever: the information about that turn stays what it
/// was, to rounding, after any number of updates. For the same reason the tangent spaces of
/// expected, detected and new pose are told apart (by the Jacobians of exp) only without such an
/// axis; with one, all that is left between them is a swing, which the gate keeps small.
[[nodiscard]] PoseDistribution updated_pose(PoseDistribution const& expected,
                                            PoseDistribution const& detected,
                                            Symmetry const& symmetry,
                                            PoseUpdate const& update = {});

}  // namespace credo
