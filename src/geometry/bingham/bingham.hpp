#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace credo {

/// Unit quaternions as points (w, x, y, z) of the sphere S^3; Eigen's own order is (x, y, z, w).
[[nodiscard]] Eigen::Vector4d wxyz(Eigen::Quaterniond const& rotation);
[[nodiscard]] Eigen::Quaterniond quaternion_of(Eigen::Vector4d const& wxyz);
/// The matrix of left multiplication: left_product(a) b = a (x) b, both (w, x, y, z).
[[nodiscard]] Eigen::Matrix4d left_product(Eigen::Vector4d const& a);
/// The matrix of right multiplication: right_product(b) a = a (x) b.
[[nodiscard]] Eigen::Matrix4d right_product(Eigen::Vector4d const& b);

/// The Bingham distribution over rotations (Bingham 1974; Glover and Popovic 2013): a unit
/// quaternion q = (w, x, y, z) has the density exp(q^T A q) / C on the sphere S^3, the same for q
/// and -q, which are one rotation. A = V diag(z1, z2, z3, 0) V^T; A and A + c I are the same
/// distribution.
class Bingham {
public:
  /// Uniform: every rotation is as likely.
  Bingham() = default;
  /// `axes`: orthonormal columns, of which the last is the mode. `concentrations`: of the others,
  /// z1 <= z2 <= z3 <= 0. Anything else throws std::logic_error.
  Bingham(Eigen::Matrix4d const& axes, Eigen::Vector3d const& concentrations);
  /// From any symmetric A (of another one, the symmetric part); its largest eigenvalue is shifted
  /// to 0. Equal largest eigenvalues are no error: the mode is then one of many. Throws
  /// std::logic_error where A is not finite.
  [[nodiscard]] static Bingham of_parameters(Eigen::Matrix4d const& A);

  /// A, with largest eigenvalue 0.
  [[nodiscard]] Eigen::Matrix4d parameters() const;
  [[nodiscard]] Eigen::Matrix4d const& axes() const { return axes_; }
  [[nodiscard]] Eigen::Vector3d const& concentrations() const { return concentrations_; }
  /// The likeliest rotation.
  [[nodiscard]] Eigen::Quaterniond mode() const { return quaternion_of(axes_.col(3)); }
  /// q^T A q <= 0, the logarithm of the density over the density at the mode.
  [[nodiscard]] double log_ratio_to_mode(Eigen::Quaterniond const& rotation) const;

private:
  Eigen::Matrix4d axes_ = default_axes();
  Eigen::Vector3d concentrations_ = Eigen::Vector3d::Zero();

  /// Turns about x, y and z, then no turn at all.
  static Eigen::Matrix4d default_axes();
};

/// What two independent sources say together: the densities' product, normalised again.
[[nodiscard]] Bingham product(Bingham const& a, Bingham const& b);
/// The distribution of r (x) q: turned by r afterwards. `r` is a unit quaternion.
[[nodiscard]] Bingham rotated_left(Eigen::Quaterniond const& r, Bingham const& q);
/// The distribution of q (x) r: turned by r before.
[[nodiscard]] Bingham rotated_right(Bingham const& q, Eigen::Quaterniond const& r);
/// The distribution of the inverse rotation.
[[nodiscard]] Bingham inverse(Bingham const& q);

}  // namespace credo
