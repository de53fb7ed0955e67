#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>
#include <span>

#include "core/se3.hpp"
#include "geometry/bingham/bingham.hpp"

namespace credo {

/// A point of the model and where it was observed, the latter with the same error in every
/// direction; sigma_m > 0.
struct PointMatch {
  Eigen::Vector3d model_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d observed_m = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;
};

/// A direction of the model and as it was observed, both of unit length: a point at infinity. It
/// weighs as much as one over its variance, kappa = 1 / sigma^2 [1/rad^2], >= 0.
struct DirectionMatch {
  Eigen::Vector3d model = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d observed = Eigen::Vector3d::UnitZ();
  double kappa = 0.0;
};

/// A surface's normal and a direction of its curvature, perpendicular to it, which nobody can tell
/// from its opposite: `observed` may stand for either.
struct FrameMatch {
  DirectionMatch normal;
  DirectionMatch curvature;
};

/// What is taken to correspond. A point of a surface with normal and curvature adds to both
/// `points` and `frames`.
struct ProcrustesMatches {
  std::span<PointMatch const> points;
  std::span<DirectionMatch const> directions;
  std::span<FrameMatch const> frames;
};

/// Of a normal, as the authors weigh it: a deviation of 8.1 degrees.
inline constexpr double kNormalKappa = 50.0;
/// Of a curvature direction, as the authors weigh it: 5 (ratio - 1), at most what a normal has, for
/// principal curvatures in such a ratio >= 1. A sphere's 1 tells no direction; infinite for a
/// cylinder.
[[nodiscard]] double curvature_kappa(double curvature_ratio);

/// All that correspondences say about a pose T_observed_model, errors being normal: a distribution
/// of the rotation, and one of the translation for each rotation.
struct ProcrustesPose {
  Bingham rotation;
  /// Weighted means of the points.
  Eigen::Vector3d model_centroid_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d observed_centroid_m = Eigen::Vector3d::Zero();
  /// Sum of 1 / sigma^2. Given the rotation, the variance of the translation in every direction is
  /// one over it.
  double weight_per_m2 = 0.0;

  /// The mean translation, given the rotation.
  [[nodiscard]] Eigen::Vector3d translation_m(Eigen::Quaterniond const& R) const {
    return observed_centroid_m - R * model_centroid_m;
  }
};

/// Bingham Procrustean alignment (Glover and Popovic 2013). Without a prior about the translation,
/// the squared residuals are a quadratic form of the quaternion: its matrix is Horn's (1987), and
/// the result is exact. A prior about the rotation multiplies. One point leaves the rotation
/// uniform; points in a line leave the turn about it, and so on: no error. No points, NaN or
/// sigma 0 throw std::logic_error. Allocates nothing.
[[nodiscard]] ProcrustesPose align(std::span<PointMatch const> points,
                                   std::span<DirectionMatch const> directions = {},
                                   Bingham const& prior = {});
/// The same with frames. Of the two rotations that take a model frame onto the observed one that is
/// meant which points, directions, prior and the frames before like better; where they like both,
/// as they do for a single correspondence, it is drawn.
[[nodiscard]] ProcrustesPose align(ProcrustesMatches const& matches, std::mt19937_64& random,
                                   Bingham const& prior = {});

/// The likeliest pose.
[[nodiscard]] Se3 best_pose(ProcrustesPose const& pose);
[[nodiscard]] Se3 sample_pose(ProcrustesPose const& pose, std::mt19937_64& random);

/// In the convention of boxplus. Turning moves the origin where it is off the centroid of the
/// points, so that both errors are correlated. Rotations spread by more than 0.4 rad do not fit
/// into it (tangent.hpp).
[[nodiscard]] PoseDistribution pose_distribution(ProcrustesPose const& pose);

/// What is known beforehand about the translation; positive definite.
struct TranslationPrior {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity();
};

struct WeightedPose {
  Se3 pose;
  /// Logarithm of the prior's density at what the correspondences say, given the drawn rotation.
  double log_weight = 0.0;
};

/// With such a prior, rotation and translation do not separate: the rotation is drawn without it,
/// the translation with it, and draws stand for the distribution only with their weights. Throws
/// std::logic_error where the covariance is not positive definite.
[[nodiscard]] WeightedPose sample_pose(ProcrustesPose const& pose, TranslationPrior const& prior,
                                       std::mt19937_64& random);

}  // namespace credo
