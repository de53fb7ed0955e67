#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace credo {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid motion p_a = R p_b + t; `T_a_b` by name. Doubles; the rotation is kept orthonormal.
class Se3 {
public:
  Se3() = default;
  /// Normalises the quaternion; a zero or non-finite one throws std::logic_error.
  Se3(Eigen::Quaterniond const& rotation, Eigen::Vector3d translation_m);
  /// Takes a 4x4 rigid matrix. Rotations off by rounding (up to `tolerance` in R^T R) are projected
  /// onto SO(3); anything else (scale, mirror, NaN, last row not 0 0 0 1) throws
  /// std::invalid_argument that says which.
  static Se3 from_matrix(Eigen::Matrix4d const& matrix, double tolerance = 1e-3);

  [[nodiscard]] Eigen::Quaterniond const& rotation() const { return rotation_; }
  [[nodiscard]] Eigen::Vector3d const& translation() const { return translation_m_; }
  [[nodiscard]] Eigen::Matrix4d matrix() const;
  [[nodiscard]] Se3 inverse() const;
  [[nodiscard]] Eigen::Vector3d operator*(Eigen::Vector3d const& point) const {
    return rotation_ * point + translation_m_;
  }
  [[nodiscard]] Se3 operator*(Se3 const& other) const;

private:
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_m_ = Eigen::Vector3d::Zero();
};

/// The matrix of v x, that takes w to the cross product v x w.
Eigen::Matrix3d cross_matrix(Eigen::Vector3d const& v);
/// Rotation by |phi| radians about phi; exact series near zero.
Eigen::Quaterniond so3_exp(Eigen::Vector3d const& phi_rad);
/// Rotation vector of least length, |phi| <= pi; inverse of so3_exp for |phi| < pi.
Eigen::Vector3d so3_log(Eigen::Quaterniond const& rotation);

/// How exp changes with its argument, on the right: exp(phi + d) = exp(phi) exp(J d) to first order
/// in d (Sola, Deray and Atchuthan 2018, equations 143 and 144).
Eigen::Matrix3d so3_right_jacobian(Eigen::Vector3d const& phi_rad);
/// Its inverse, for |phi| < 2 pi.
Eigen::Matrix3d so3_right_jacobian_inverse(Eigen::Vector3d const& phi_rad);

/// Turns about the fixed axes x, then y, then z, degrees.
Eigen::Quaterniond rotation_of_rpy_deg(Eigen::Vector3d const& rpy_deg);

/// The fixed error convention at every boundary: p = p_mean + delta, R = exp(phi) R_mean, both
/// along the axes of the frame in which the pose is given, order (delta [m], phi [rad]).
Se3 boxplus(Se3 const& mean, Vector6d const& error);
/// The error that takes `mean` to `pose`: boxplus(mean, boxminus(pose, mean)) = pose.
Vector6d boxminus(Se3 const& pose, Se3 const& mean);

/// A normal distribution over poses; covariance of (delta, phi) in the convention of boxplus.
struct PoseDistribution {
  Se3 mean;
  Matrix6d covariance = Matrix6d::Zero();
};

/// The same distribution told in frame a, given where b stands in a (taken as exact).
PoseDistribution transformed(Se3 const& T_a_b, PoseDistribution const& pose_b);

}  // namespace credo
