#include "geometry/pose_fusion.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace credo {
namespace {

/// What does not move when the model turns in its symmetry.
Eigen::Vector3d centre_of(Symmetry const& symmetry) {
  return symmetry.axis ? symmetry.axis->point_m : Eigen::Vector3d(0, 0, 0);
}

/// Turning about the symmetry axis, in the coordinates of model_errors.
Vector6d unseen_direction(SymmetryAxis const& axis) {
  Vector6d direction = Vector6d::Zero();
  direction.tail<3>() = axis.direction;
  return direction;
}

/// Takes errors (delta, phi) along the frame's axes about `pose` (se3.hpp) to errors (shift of the
/// centre along the frame's axes, turn about the model's axes).
Matrix6d model_errors(Se3 const& pose, Eigen::Vector3d const& centre) {
  Eigen::Matrix3d const R = pose.rotation().toRotationMatrix();
  Matrix6d map = Matrix6d::Identity();
  map.topRightCorner<3, 3>() = -cross_matrix(R * centre);
  map.bottomRightCorner<3, 3>() = R.transpose();
  return map;
}

Matrix6d frame_errors(Se3 const& pose, Eigen::Vector3d const& centre) {
  Eigen::Matrix3d const R = pose.rotation().toRotationMatrix();
  Matrix6d map = Matrix6d::Identity();
  map.topRightCorner<3, 3>() = cross_matrix(R * centre) * R;
  map.bottomRightCorner<3, 3>() = R;
  return map;
}

Matrix6d symmetric(Matrix6d const& m) {
  return 0.5 * (m + m.transpose());
}

Matrix6d inverse_of(Matrix6d const& covariance) {
  Eigen::LLT<Matrix6d> const factor(symmetric(covariance));
  if (factor.info() != Eigen::Success) {
    throw std::logic_error("pose fusion: a covariance is not positive definite");
  }
  return symmetric(factor.solve(Matrix6d::Identity()));
}

/// The part of the information that knows nothing about one direction: what is left when that
/// direction's variance grows without bound.
Matrix6d without(Matrix6d const& information, Vector6d const& direction) {
  Vector6d const toward = information * direction;
  return symmetric(information - toward * toward.transpose() / direction.dot(toward));
}

/// The turn of the detected pose about its own axis after which only a swing is left to the
/// expected one.
Se3 turned_back(Se3 const& expected, Se3 const& detected, SymmetryAxis const& axis) {
  Eigen::Quaterniond const apart = expected.rotation().conjugate() * detected.rotation();
  double const turn_rad = 2.0 * std::atan2(apart.vec().dot(axis.direction), apart.w());
  Eigen::Quaterniond const back = so3_exp(-turn_rad * axis.direction);
  return detected * Se3(back, axis.point_m - back * axis.point_m);
}

/// Both poses in the coordinates that the update works in.
struct Comparison {
  Vector6d difference;
  Matrix6d expected_covariance;
  Matrix6d detected_covariance;
};

/// `equivalent` looks like the detected pose.
Comparison compared(PoseDistribution const& expected, PoseDistribution const& detected,
                    Se3 const& equivalent, Symmetry const& symmetry) {
  Eigen::Vector3d const centre = centre_of(symmetry);
  Comparison result;
  result.difference << equivalent * centre - expected.mean * centre,
      so3_log(expected.mean.rotation().conjugate() * equivalent.rotation());
  Matrix6d const to_model = model_errors(expected.mean, centre);
  result.expected_covariance = symmetric(to_model * expected.covariance * to_model.transpose());
  // The covariance tells of the detected pose; its errors move the equivalent with it.
  Matrix6d moved = Matrix6d::Identity();
  moved.topRightCorner<3, 3>() =
      -cross_matrix(equivalent.translation() - detected.mean.translation());
  Matrix6d from_detected = model_errors(equivalent, centre) * moved;
  if (!symmetry.axis) {
    from_detected.bottomRows<3>() =
        so3_right_jacobian_inverse(result.difference.tail<3>()) * from_detected.bottomRows<3>();
  }
  result.detected_covariance =
      symmetric(from_detected * detected.covariance * from_detected.transpose());
  return result;
}

PoseMatch match_of(Comparison const& comparison, Symmetry const& symmetry) {
  Matrix6d const sum = comparison.expected_covariance + comparison.detected_covariance;
  Matrix6d information = inverse_of(sum);
  PoseMatch match;
  match.log_determinant = std::log(sum.determinant());
  if (symmetry.axis) {
    // The determinant of the rest is the whole's times the information about what is left out.
    Vector6d const unseen = unseen_direction(*symmetry.axis);
    match.log_determinant += std::log(unseen.dot(information * unseen));
    match.degrees_of_freedom = 5;
    information = without(information, unseen);
  }
  match.squared_distance = comparison.difference.dot(information * comparison.difference);
  return match;
}

std::pair<Comparison, PoseMatch> nearest(PoseDistribution const& expected,
                                         PoseDistribution const& detected,
                                         Symmetry const& symmetry) {
  Se3 const first =
      symmetry.axis ? turned_back(expected.mean, detected.mean, *symmetry.axis) : detected.mean;
  Comparison best = compared(expected, detected, first, symmetry);
  PoseMatch best_match = match_of(best, symmetry);
  auto const consider = [&](Se3 const& equivalent) {
    Comparison const other = compared(expected, detected, equivalent, symmetry);
    PoseMatch const match = match_of(other, symmetry);
    if (match.squared_distance < best_match.squared_distance) {
      best = other;
      best_match = match;
    }
  };
  for (Eigen::Quaterniond const& rotation : symmetry.rotations) {
    consider(detected.mean * Se3(rotation, Eigen::Vector3d::Zero()));
  }
  if (symmetry.axis && symmetry.axis->both_ways) {
    consider(
        turned_back(expected.mean, detected.mean * end_for_end(*symmetry.axis), *symmetry.axis));
  }
  return {best, best_match};
}

/// The information that is left when so much is forgotten that with `weight` more of `look` the
/// covariance is, in no direction, less than the share of the look's. Of `told` directions a look
/// tells something; about the others nothing is forgotten.
Matrix6d with_room(Matrix6d const& information, Matrix6d const& look, Eigen::Index told,
                   PoseUpdate const& update) {
  Eigen::SelfAdjointEigenSolver<Matrix6d> const parts(look);
  // look = root root^T, and `whiten` is the inverse of root on what a look tells of.
  Eigen::MatrixXd const axes = parts.eigenvectors().rightCols(told);
  Eigen::VectorXd const scale = parts.eigenvalues().tail(told).cwiseSqrt();
  Eigen::MatrixXd const root = axes * scale.asDiagonal();
  Eigen::MatrixXd const whiten = scale.cwiseInverse().asDiagonal() * axes.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const looks(whiten * information *
                                                             whiten.transpose());
  Eigen::VectorXd const excess =
      (looks.eigenvalues().array() + update.weight - 1.0 / update.min_covariance_share)
          .cwiseMax(0.0);
  Eigen::MatrixXd const spread = root * looks.eigenvectors();
  return symmetric(information - spread * excess.asDiagonal() * spread.transpose());
}

void check(PoseUpdate const& update) {
  if (!(update.weight > 0.0 && update.weight <= 1.0)) {
    throw std::logic_error("updated_pose: weight " + std::to_string(update.weight) +
                           " must be in (0, 1]");
  }
  if (!(update.min_covariance_share >= 0.0 && update.min_covariance_share <= 0.5)) {
    throw std::logic_error("updated_pose: min_covariance_share " +
                           std::to_string(update.min_covariance_share) + " must be in [0, 0.5]");
  }
}

}  // namespace

PoseMatch match_pose(PoseDistribution const& expected, PoseDistribution const& detected,
                     Symmetry const& symmetry) {
  return nearest(expected, detected, symmetry).second;
}

PoseDistribution updated_pose(PoseDistribution const& expected, PoseDistribution const& detected,
                              Symmetry const& symmetry, PoseUpdate const& update) {
  check(update);
  Eigen::Vector3d const centre = centre_of(symmetry);
  Comparison const comparison = nearest(expected, detected, symmetry).first;
  Matrix6d look = inverse_of(comparison.detected_covariance);
  if (symmetry.axis) {
    look = without(look, unseen_direction(*symmetry.axis));
  }
  Matrix6d known = inverse_of(comparison.expected_covariance);
  if (update.min_covariance_share > 0.0) {
    known = with_room(known, look, symmetry.axis ? 5 : 6, update);
  }
  Matrix6d const news = update.weight * look;
  Matrix6d covariance = inverse_of(known + news);
  Vector6d const correction = covariance * (news * comparison.difference);
  if (!symmetry.axis) {
    Matrix6d moved = Matrix6d::Identity();
    moved.bottomRightCorner<3, 3>() = so3_right_jacobian(correction.tail<3>());
    covariance = moved * covariance * moved.transpose();
  }
  Eigen::Quaterniond const rotation = expected.mean.rotation() * so3_exp(correction.tail<3>());
  Eigen::Vector3d const centre_now = expected.mean * centre + correction.head<3>();
  Se3 const mean(rotation, centre_now - rotation * centre);
  Matrix6d const to_frame = frame_errors(mean, centre);
  return {mean, symmetric(to_frame * covariance * to_frame.transpose())};
}

double largest_deviation_m(PoseDistribution const& pose, double radius_m,
                           Symmetry const& symmetry) {
  Matrix6d covariance = pose.covariance;
  if (symmetry.axis) {
    Matrix6d to_seen = model_errors(pose.mean, symmetry.axis->point_m);
    Eigen::Vector3d const& axis = symmetry.axis->direction;
    to_seen.bottomRows<3>() -= axis * (axis.transpose() * to_seen.bottomRows<3>());
    covariance = to_seen * covariance * to_seen.transpose();
  }
  double const shifted_m2 = covariance.topLeftCorner<3, 3>().diagonal().maxCoeff();
  double const turned_rad2 = covariance.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  return std::sqrt(std::max(0.0, shifted_m2 + turned_rad2 * radius_m * radius_m));
}

}  // namespace credo
