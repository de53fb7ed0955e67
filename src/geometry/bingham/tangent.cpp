#include "geometry/bingham/tangent.hpp"

#include <Eigen/Eigenvalues>
#include <sstream>
#include <stdexcept>

#include "geometry/bingham/constant.hpp"

namespace credo {

Eigen::Matrix3d tangent_covariance_body_rad2(Bingham const& distribution) {
  Eigen::Vector3d const moments = bingham_constant(distribution.concentrations()).gradient;
  Eigen::Vector4d const back = wxyz(distribution.mode().conjugate());
  // What is left of an axis when the mode is turned back to no turn: its direction, w being 0.
  Eigen::Matrix3d const turns =
      (left_product(back) * distribution.axes().leftCols<3>()).bottomRows<3>();
  return turns * (4.0 * moments).asDiagonal() * turns.transpose();
}

Eigen::Matrix3d tangent_covariance_world_rad2(Bingham const& distribution) {
  Eigen::Matrix3d const R = distribution.mode().toRotationMatrix();
  return R * tangent_covariance_body_rad2(distribution) * R.transpose();
}

bool is_tangent_covariance_valid(Bingham const& distribution) {
  constexpr double kLargest_rad = 0.4;
  double const largest_moment = bingham_constant(distribution.concentrations()).gradient[2];
  return 4.0 * largest_moment < kLargest_rad * kLargest_rad;
}

Bingham bingham_of_body_covariance(Eigen::Quaterniond const& mode,
                                   Eigen::Matrix3d const& covariance_rad2) {
  constexpr double kLeastVariance_rad2 = 2e-9;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const parts(
      0.5 * (covariance_rad2 + covariance_rad2.transpose()));
  if (!covariance_rad2.allFinite() ||
      parts.eigenvalues()[0] < -1e-9 * parts.eigenvalues().cwiseAbs().maxCoeff()) {
    std::ostringstream text;
    text << "Bingham: no covariance of a rotation:\n" << covariance_rad2;
    throw std::logic_error(text.str());
  }
  Eigen::Matrix4d axes = Eigen::Matrix4d::Zero();
  axes.bottomLeftCorner<3, 3>() = parts.eigenvectors();
  axes(0, 3) = 1.0;
  Eigen::Vector3d const variances_rad2 = parts.eigenvalues().cwiseMax(kLeastVariance_rad2);
  return {left_product(wxyz(mode)) * axes, -2.0 * variances_rad2.cwiseInverse()};
}

Bingham bingham_of_world_covariance(Eigen::Quaterniond const& mode,
                                    Eigen::Matrix3d const& covariance_rad2) {
  Eigen::Matrix3d const R = mode.toRotationMatrix();
  return bingham_of_body_covariance(mode, R.transpose() * covariance_rad2 * R);
}

}  // namespace credo
