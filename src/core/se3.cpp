#include "core/se3.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace credo {
namespace {

/// Below this a quotient of small numbers loses more digits than a series' next term.
constexpr double kSmallAngle_rad = 1e-3;

}  // namespace

Se3::Se3(Eigen::Quaterniond const& rotation, Eigen::Vector3d translation_m)
    : rotation_(rotation), translation_m_(std::move(translation_m)) {
  double const norm = rotation_.norm();
  if (!(norm > 1e-12) || !std::isfinite(norm)) {
    throw std::logic_error("Se3: quaternion of norm " + std::to_string(norm));
  }
  // What is of unit length but for rounding stays as it is: normalising it anew would turn it by a
  // last bit every time, and a pose that is written and read back would not be the same.
  constexpr double kRounding = 1e-15;
  if (std::abs(norm - 1.0) > kRounding) {
    rotation_.coeffs() /= norm;
  }
}

Se3 Se3::from_matrix(Eigen::Matrix4d const& matrix, double tolerance) {
  if (!matrix.allFinite()) {
    throw std::invalid_argument("pose has a number that is not finite");
  }
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-9) {
    throw std::invalid_argument("last row of the pose is not 0 0 0 1");
  }
  Eigen::Matrix3d const rotation = matrix.topLeftCorner<3, 3>();
  double const error =
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (error > tolerance || rotation.determinant() <= 0) {
    throw std::invalid_argument("the 3x3 part of the pose is not a rotation");
  }
  Eigen::JacobiSVD<Eigen::Matrix3d> const svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d const nearest = svd.matrixU() * svd.matrixV().transpose();
  return {Eigen::Quaterniond(nearest), matrix.topRightCorner<3, 1>()};
}

Eigen::Matrix4d Se3::matrix() const {
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<3, 3>() = rotation_.toRotationMatrix();
  result.topRightCorner<3, 1>() = translation_m_;
  return result;
}

Se3 Se3::inverse() const {
  Eigen::Quaterniond const inverse = rotation_.conjugate();
  return {inverse, -(inverse * translation_m_)};
}

Se3 Se3::operator*(Se3 const& other) const {
  return {rotation_ * other.rotation_, rotation_ * other.translation_m_ + translation_m_};
}

Eigen::Matrix3d cross_matrix(Eigen::Vector3d const& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond so3_exp(Eigen::Vector3d const& phi_rad) {
  double const angle = phi_rad.norm();
  // sin(a/2)/a by its series near zero, where the quotient loses digits.
  double const scale = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Vector3d const v = scale * phi_rad;
  return {std::cos(0.5 * angle), v.x(), v.y(), v.z()};
}

Eigen::Vector3d so3_log(Eigen::Quaterniond const& rotation) {
  // q and -q are one rotation; w >= 0 picks the shorter way round.
  double const sign = rotation.w() < 0 ? -1.0 : 1.0;
  Eigen::Vector3d const v = sign * rotation.vec();
  double const sine = v.norm();
  double const cosine = sign * rotation.w();
  if (sine < 1e-7) {
    return 2.0 / cosine * v;
  }
  return 2.0 * std::atan2(sine, cosine) / sine * v;
}

Eigen::Matrix3d so3_right_jacobian(Eigen::Vector3d const& phi_rad) {
  double const angle2 = phi_rad.squaredNorm();
  double const angle = std::sqrt(angle2);
  bool const small = angle < kSmallAngle_rad;
  Eigen::Matrix3d const cross = cross_matrix(phi_rad);
  double const first = small ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  double const second =
      small ? 1.0 / 6.0 - angle2 / 120.0 : (angle - std::sin(angle)) / (angle2 * angle);
  return Eigen::Matrix3d::Identity() - first * cross + second * cross * cross;
}

Eigen::Matrix3d so3_right_jacobian_inverse(Eigen::Vector3d const& phi_rad) {
  double const angle2 = phi_rad.squaredNorm();
  double const angle = std::sqrt(angle2);
  Eigen::Matrix3d const cross = cross_matrix(phi_rad);
  double const second = angle < kSmallAngle_rad
                            ? 1.0 / 12.0 + angle2 / 720.0
                            : 1.0 / angle2 - 0.5 / (angle * std::tan(0.5 * angle));
  return Eigen::Matrix3d::Identity() + 0.5 * cross + second * cross * cross;
}

Eigen::Quaterniond rotation_of_rpy_deg(Eigen::Vector3d const& rpy_deg) {
  Eigen::Vector3d const turn_rad = rpy_deg * (std::numbers::pi / 180.0);
  return so3_exp({0, 0, turn_rad.z()}) * so3_exp({0, turn_rad.y(), 0}) *
         so3_exp({turn_rad.x(), 0, 0});
}

Se3 boxplus(Se3 const& mean, Vector6d const& error) {
  return {so3_exp(error.tail<3>()) * mean.rotation(), mean.translation() + error.head<3>()};
}

Vector6d boxminus(Se3 const& pose, Se3 const& mean) {
  Vector6d error;
  error << pose.translation() - mean.translation(),
      so3_log(pose.rotation() * mean.rotation().conjugate());
  return error;
}

PoseDistribution transformed(Se3 const& T_a_b, PoseDistribution const& pose_b) {
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = T_a_b.rotation().toRotationMatrix();
  turn.bottomRightCorner<3, 3>() = turn.topLeftCorner<3, 3>();
  return {T_a_b * pose_b.mean, turn * pose_b.covariance * turn.transpose()};
}

}  // namespace credo
