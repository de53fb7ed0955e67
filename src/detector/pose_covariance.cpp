#include "detector/pose_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "detector/open_turn.hpp"
#include "detector/pose_refinement.hpp"

namespace credo {
namespace {

constexpr std::size_t kPoints = 800;
/// Residuals of right poses, in variances of a pixel: normals are of smoothed depth, and so is what
/// points fall on. Where they are larger, model, pose or sensor is worse than thought, and tells
/// less by as much.
constexpr double kUsualResidual = 0.3;
/// Neighbouring pixels err alike: so many of them are worth one.
constexpr double kEffectiveShare = 0.45;
/// What all points of an object may have in common, at 1 m; it grows with the square of the range,
/// as the sensor's steps do.
constexpr double kBiasAlongRay_m = 0.0003;
constexpr double kBiasAcross_m = 0.0002;
/// By so much one end of it may be shifted against the middle.
constexpr double kBiasOfEnds_m = 0.0003;
constexpr double kUnknown_m = 1.0;
constexpr double kUnknown_rad = 2.0;

/// Takes out what a turn about a symmetry axis would tell: a mesh of a round thing has corners.
void forget_turn(Matrix6d& information, SymmetryAxis const& axis, CameraPose const& pose) {
  Eigen::Matrix3d const rotation = pose.rotation.cast<double>();
  Eigen::Vector3d const direction = rotation * axis.direction;
  // The origin moves where it is off the axis.
  Vector6d turn;
  turn << direction.cross(-(rotation * axis.point_m)), direction;
  Vector6d const told = information * turn;
  double const about = turn.dot(told);
  if (about > 0.0) {
    information -= told * told.transpose() / about;
  }
}

/// Of errors that no number of points makes less.
Matrix6d bias_of(SearchModel const& model, CameraPose const& pose) {
  Eigen::Vector3d const centre = (pose * model.centre_model).cast<double>();
  double const range_factor = centre.z() * centre.z();
  Eigen::Vector3d const ray = centre.normalized();
  Matrix6d bias = Matrix6d::Zero();
  bias.topLeftCorner<3, 3>() =
      kBiasAcross_m * kBiasAcross_m * Eigen::Matrix3d::Identity() +
      (kBiasAlongRay_m * kBiasAlongRay_m - kBiasAcross_m * kBiasAcross_m) * ray * ray.transpose();
  double const turn_rad = 2.0 * kBiasOfEnds_m / static_cast<double>(model.diameter_m);
  Eigen::Vector3d const to_origin = pose.translation_m.cast<double>() - centre;
  for (int axis = 0; axis < 3; ++axis) {
    Vector6d motion;
    motion << Eigen::Vector3d::Unit(axis).cross(to_origin), Eigen::Vector3d::Unit(axis);
    bias += turn_rad * turn_rad * motion * motion.transpose();
  }
  return range_factor * range_factor * bias;
}

}  // namespace

Matrix6d pose_information(SearchModel const& model, SearchScene const& scene,
                          CameraPose const& pose) {
  PoseEvidence const evidence = evidence_of(model, scene, pose, kPoints);
  Matrix6d information =
      evidence.information *
      (kEffectiveShare / std::max(kUsualResidual, evidence.mean_squared_residual));
  if (model.symmetry.axis) {
    forget_turn(information, *model.symmetry.axis, pose);
  }
  information.diagonal().head<3>().array() += 1.0 / (kUnknown_m * kUnknown_m);
  information.diagonal().tail<3>().array() += 1.0 / (kUnknown_rad * kUnknown_rad);
  return information;
}

PoseDistribution with_covariance(SearchModel const& model, SearchScene const& scene,
                                 CameraPose const& pose) {
  Matrix6d const information = pose_information(model, scene, pose);
  OpenTurn const open = open_turn(model, scene, pose, information);
  Matrix6d covariance =
      information.inverse() + open.deviation * open.deviation.transpose() + bias_of(model, pose);
  covariance = (covariance + covariance.transpose()) / 2.0;
  return {se3(open.pose), covariance};
}

}  // namespace credo
