#pragma once

#include <Eigen/Core>

#include "geometry/bingham/bingham.hpp"

namespace credo {

/// The normalising constant C = 2 pi^2 F of a Bingham distribution, and how it changes:
/// F = 1F1(1/2; 2; diag(z1, z2, z3, 0)), F(0) = 1.
struct BinghamConstant {
  double log_F = 0.0;
  /// d ln F / d z_i = E[(v_i . q)^2]; the mode's is 1 less their sum.
  Eigen::Vector3d gradient = Eigen::Vector3d::Constant(0.25);
  /// The second derivatives of ln F = covariance of the (v_i . q)^2.
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

/// For z1 <= z2 <= z3 <= 0; anything else throws std::logic_error. S^3 is split into two circles:
/// what is left is one integral, taken by 32 Gauss-Legendre nodes that crowd where the integrand
/// does. Relative error of F: 1e-8 for z down to -1e5, 1e-4 down to -1e9.
[[nodiscard]] BinghamConstant bingham_constant(Eigen::Vector3d const& concentrations);

/// The logarithm of the density with respect to the surface of S^3, whose area is 2 pi^2. Works out
/// the constant each time: compare log_ratio_to_mode where only ratios matter.
[[nodiscard]] double log_density(Bingham const& distribution, Eigen::Quaterniond const& rotation);

/// Differential entropy on S^3 [nat]: 2.98 where uniform, without lower bound.
[[nodiscard]] double entropy(Bingham const& distribution);

}  // namespace credo
