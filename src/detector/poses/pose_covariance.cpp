#include "detector/poses/pose_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "detector/poses/open_turn.hpp"
#include "detector/poses/pose_evidence.hpp"

namespace credo {
namespace {

/// Errors of the surface are as large as the residuals are, but neighbouring pixels err alike: so
/// many are worth one. Those of the silhouette are less than they might be.
constexpr double kSurfaceWorth = 0.65;
constexpr double kEdgeWorth = 2.4;
/// What all depths of an object may have in common, at 1 m; it grows with the square of the range,
/// as the sensor's steps do.
constexpr double kCommonDepth_m = 0.00006;
/// And all of its silhouette.
constexpr double kCommonEdge_m = 0.00057;
/// No residuals make a surface more exact than this, in variances.
constexpr double kLeastResidual = 0.1;
/// Residuals of right poses, squared, in variances: normals are of smoothed depth, and so is what
/// points fall on. Where they are larger, model, pose or sensor is worse than thought.
constexpr double kUsualResidual = 0.23;
constexpr double kUsualEdgeResidual = 0.2;
/// As if errors had nothing in common, so many of the points are worth one.
constexpr double kInformationWorth = 0.35;
/// What is known without looking.
constexpr double kUnknown_m = 1.0;
constexpr double kUnknown_rad = 2.0;
/// A metre beside the millimetre that one point is known to, squared.
constexpr double kWithoutLooking = 1e-6;

Matrix6d without_looking() {
  Vector6d known;
  known << Eigen::Vector3d::Constant(1.0 / (kUnknown_m * kUnknown_m)),
      Eigen::Vector3d::Constant(1.0 / (kUnknown_rad * kUnknown_rad));
  return known.asDiagonal();
}

/// What a turn about a symmetry axis would tell does not count: a mesh of a round thing has
/// corners.
void forget_turn(Matrix6d& covariance, SymmetryAxis const& axis, CameraPose const& pose) {
  Eigen::Matrix3d const rotation = pose.rotation.cast<double>();
  Eigen::Vector3d const direction = rotation * axis.direction;
  // The origin moves where it is off the axis.
  Vector6d turn;
  turn << direction.cross(-(rotation * axis.point_m)), direction;
  covariance += kUnknown_rad * kUnknown_rad * turn * turn.transpose();
}

/// How much more a pose may be off, variance for variance, the worse it lies on what is seen.
double poor_fit(PoseEvidence const& evidence) {
  double const surface = std::max(1.0, evidence.mean_squared_residual / kUsualResidual);
  double const edges = std::max(1.0, evidence.mean_squared_edge_residual / kUsualEdgeResidual);
  return surface * std::sqrt(surface) * std::cbrt(edges);
}

Matrix6d outer(Eigen::Matrix<double, 6, 3> const& m) {
  return m * m.transpose();
}

/// What the errors of all that is measured make of the pose. What is known without looking holds it
/// a little, too, and errs as much as that is worth.
Matrix6d covariance_by(PoseEvidence const& evidence, float depth_m) {
  double const common_depth_m = kCommonDepth_m * static_cast<double>(depth_m * depth_m);
  double const surface_residual = std::max(kLeastResidual, evidence.mean_squared_residual);
  Matrix6d const pulls = surface_residual / kSurfaceWorth * evidence.surface_noise +
                         evidence.edge_noise / kEdgeWorth +
                         common_depth_m * common_depth_m * outer(evidence.common_depth) +
                         kCommonEdge_m * kCommonEdge_m * outer(evidence.common_edge);
  Matrix6d const prior = kWithoutLooking * without_looking();
  Matrix6d const gain = (evidence.hold + prior).inverse();
  return gain * (poor_fit(evidence) * pulls + kWithoutLooking * prior) * gain.transpose();
}

Matrix6d information_by(PoseEvidence const& evidence) {
  double const residual = std::max(kUsualResidual, evidence.mean_squared_residual);
  return kInformationWorth / residual * evidence.information + without_looking();
}

}  // namespace

Matrix6d pose_information(SearchModel const& model, SearchScene const& scene,
                          CameraPose const& pose) {
  return information_by(evidence_of(model, scene, pose));
}

PoseDistribution with_covariance(SearchModel const& model, SearchScene const& scene,
                                 CameraPose const& pose) {
  PoseEvidence const evidence = evidence_of(model, scene, pose);
  float const depth_m = (pose * model.centre_model).z();
  OpenTurn const open = open_turn(model, scene, pose, information_by(evidence));
  Matrix6d covariance = covariance_by(evidence, depth_m) + open.covariance;
  if (model.symmetry.axis) {
    forget_turn(covariance, *model.symmetry.axis, pose);
  }
  covariance = (covariance + covariance.transpose()).eval() / 2.0;
  return {se3(open.pose), covariance};
}

}  // namespace credo
