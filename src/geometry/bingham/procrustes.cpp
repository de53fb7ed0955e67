#include "geometry/bingham/procrustes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "geometry/bingham/sampling.hpp"
#include "geometry/bingham/tangent.hpp"
#include "geometry/random_draws.hpp"

namespace credo {
namespace {

/// The symmetric N of q^T N q = tr(R(q)^T M), for M = sum of weight observed model^T (Horn 1987).
Eigen::Matrix4d horn_matrix(Eigen::Matrix3d const& M) {
  Eigen::Matrix4d N;
  N(0, 0) = M.trace();
  N.bottomRightCorner<3, 3>() = M + M.transpose() - M.trace() * Eigen::Matrix3d::Identity();
  N.bottomLeftCorner<3, 1>() << M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1);
  N.topRightCorner<1, 3>() = N.bottomLeftCorner<3, 1>().transpose();
  return N;
}

Eigen::Matrix3d moment(DirectionMatch const& match) {
  return match.kappa * match.observed * match.model.transpose();
}

struct WeightedSums {
  ProcrustesPose pose;     // without rotation
  Eigen::Matrix3d moment;  // about the centroids
};

WeightedSums sums_of(std::span<PointMatch const> points) {
  WeightedSums sums{{}, Eigen::Matrix3d::Zero()};
  ProcrustesPose& pose = sums.pose;
  for (PointMatch const& point : points) {
    double const weight = 1.0 / (point.sigma_m * point.sigma_m);
    pose.weight_per_m2 += weight;
    pose.model_centroid_m += weight * point.model_m;
    pose.observed_centroid_m += weight * point.observed_m;
  }
  pose.model_centroid_m /= pose.weight_per_m2;
  pose.observed_centroid_m /= pose.weight_per_m2;
  for (PointMatch const& point : points) {
    double const weight = 1.0 / (point.sigma_m * point.sigma_m);
    sums.moment += weight * (point.observed_m - pose.observed_centroid_m) *
                   (point.model_m - pose.model_centroid_m).transpose();
  }
  if (!(pose.weight_per_m2 > 0.0) || !sums.moment.allFinite()) {
    std::ostringstream text;
    text << "align: " << points.size() << " points of total weight " << pose.weight_per_m2
         << " give no pose: one is needed, finite and of sigma > 0";
    throw std::logic_error(text.str());
  }
  return sums;
}

/// A rotation even where the directions are a little off the right angle.
Eigen::Matrix3d frame_of(Eigen::Vector3d const& normal, Eigen::Vector3d const& curvature) {
  Eigen::Vector3d const third = normal.cross(curvature).normalized();
  Eigen::Matrix3d axes;
  axes << normal, third.cross(normal), third;
  return axes;
}

/// 1 or -1, by which the observed curvature direction is to be multiplied.
double curvature_sign(FrameMatch const& match, Eigen::Matrix4d const& A, std::mt19937_64& random) {
  Eigen::Quaterniond const as_told(frame_of(match.normal.observed, match.curvature.observed) *
                                   frame_of(match.normal.model, match.curvature.model).transpose());
  // Half a turn about the normal comes first: q (x) i in the frame.
  Eigen::Vector4d const flipped = left_product(wxyz(as_told)).rightCols<3>() * match.normal.model;
  Eigen::Vector4d const told = wxyz(as_told);
  double const liking = told.dot(A * told) - flipped.dot(A * flipped);
  // As a logarithm of a ratio. Less is rounding.
  constexpr double kIndifferent = 1e-6;
  if (std::abs(liking) <= kIndifferent) {
    return draw_uniform(random) < 0.5 ? 1.0 : -1.0;
  }
  return liking > 0.0 ? 1.0 : -1.0;
}

/// Points and directions; the rotation is left out.
WeightedSums sums_of(std::span<PointMatch const> points,
                     std::span<DirectionMatch const> directions) {
  WeightedSums sums = sums_of(points);
  for (DirectionMatch const& direction : directions) {
    sums.moment += moment(direction);
  }
  return sums;
}

}  // namespace

double curvature_kappa(double curvature_ratio) {
  // The concentration about the normal is twice this.
  return std::min(5.0 * (curvature_ratio - 1.0), kNormalKappa);
}

ProcrustesPose align(std::span<PointMatch const> points, std::span<DirectionMatch const> directions,
                     Bingham const& prior) {
  WeightedSums sums = sums_of(points, directions);
  sums.pose.rotation = Bingham::of_parameters(horn_matrix(sums.moment) + prior.parameters());
  return sums.pose;
}

ProcrustesPose align(ProcrustesMatches const& matches, std::mt19937_64& random,
                     Bingham const& prior) {
  WeightedSums sums = sums_of(matches.points, matches.directions);
  Eigen::Matrix4d A = horn_matrix(sums.moment) + prior.parameters();
  for (FrameMatch const& match : matches.frames) {
    double const sign = curvature_sign(match, A, random);
    A += horn_matrix(moment(match.normal) + sign * moment(match.curvature));
  }
  sums.pose.rotation = Bingham::of_parameters(A);
  return sums.pose;
}

Se3 best_pose(ProcrustesPose const& pose) {
  Eigen::Quaterniond const R = pose.rotation.mode();
  return {R, pose.translation_m(R)};
}

Se3 sample_pose(ProcrustesPose const& pose, std::mt19937_64& random) {
  Eigen::Quaterniond const R = sample(pose.rotation, random);
  Eigen::Vector3d noise;
  for (double& value : noise) {
    value = draw_normal(random);
  }
  return {R, pose.translation_m(R) + noise / std::sqrt(pose.weight_per_m2)};
}

PoseDistribution pose_distribution(ProcrustesPose const& pose) {
  PoseDistribution result;
  result.mean = best_pose(pose);
  Eigen::Matrix3d const turns_rad2 = tangent_covariance_world_rad2(pose.rotation);
  // t = b - exp(phi) R a, to first order t_mean + (R a) x phi, and the centroids' own error.
  Eigen::Matrix3d const lever_m = cross_matrix(result.mean.rotation() * pose.model_centroid_m);
  Matrix6d covariance;
  covariance.topLeftCorner<3, 3>() =
      lever_m * turns_rad2 * lever_m.transpose() + Eigen::Matrix3d::Identity() / pose.weight_per_m2;
  covariance.topRightCorner<3, 3>() = lever_m * turns_rad2;
  covariance.bottomLeftCorner<3, 3>() = turns_rad2 * lever_m.transpose();
  covariance.bottomRightCorner<3, 3>() = turns_rad2;
  result.covariance = 0.5 * (covariance + covariance.transpose());
  return result;
}

WeightedPose sample_pose(ProcrustesPose const& pose, TranslationPrior const& prior,
                         std::mt19937_64& random) {
  Eigen::LLT<Eigen::Matrix3d> const known(prior.covariance_m2);
  if (!prior.covariance_m2.allFinite() || known.info() != Eigen::Success) {
    throw std::logic_error("sample_pose: the prior's covariance is not positive definite");
  }
  Eigen::Quaterniond const R = sample(pose.rotation, random);
  Eigen::Vector3d const told_m = pose.translation_m(R);
  Eigen::Matrix3d const identity = Eigen::Matrix3d::Identity();
  Eigen::LLT<Eigen::Matrix3d> const information(known.solve(identity) +
                                                pose.weight_per_m2 * identity);
  Eigen::Vector3d noise;
  for (double& value : noise) {
    value = draw_normal(random);
  }
  Eigen::Vector3d const translation_m =
      information.solve(known.solve(prior.mean_m) + pose.weight_per_m2 * told_m) +
      information.matrixU().solve(noise);

  Eigen::Matrix3d const spread_m2 = prior.covariance_m2 + identity / pose.weight_per_m2;
  Eigen::LLT<Eigen::Matrix3d> const spread(spread_m2);
  Eigen::Vector3d const apart_m = told_m - prior.mean_m;
  double const log_weight = -0.5 * apart_m.dot(spread.solve(apart_m)) -
                            0.5 * std::log(spread_m2.determinant()) -
                            1.5 * std::log(2.0 * std::numbers::pi);
  return {{R, translation_m}, log_weight};
}

}  // namespace credo
