#include "core/told_pose.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace credo {
namespace {

constexpr double kMaxDistanceM = 1e4;
constexpr double kMinDeviation = 1e-6;
constexpr double kMaxDeviation = 1e3;

}  // namespace

Eigen::Vector3d told_position(Eigen::Vector3d const& position_m) {
  if (!position_m.allFinite() || position_m.cwiseAbs().maxCoeff() > kMaxDistanceM) {
    throw std::invalid_argument("must be within 10000 m");
  }
  return position_m;
}

Eigen::Quaterniond told_orientation(Eigen::Quaterniond const& orientation) {
  double const length = orientation.norm();
  if (!(std::abs(length - 1.0) <= 1e-2)) {
    std::ostringstream text;
    text << "must be of length 1, has " << length;
    throw std::invalid_argument(text.str());
  }
  return orientation;
}

Matrix6d told_covariance(Matrix6d const& covariance) {
  Matrix6d symmetric = 0.5 * (covariance + covariance.transpose());
  double const off = (covariance - symmetric).cwiseAbs().maxCoeff();
  // Eigen's greatest of all may pass over a NaN.
  if (!covariance.allFinite() || !(off <= 1e-6 * covariance.cwiseAbs().maxCoeff()) ||
      symmetric.llt().info() != Eigen::ComputationInfo::Success) {
    throw std::invalid_argument("must be symmetric and positive definite");
  }
  auto const variances = symmetric.diagonal().array();
  // A little less than the square, which may be rounded.
  if (variances.minCoeff() < 0.999 * kMinDeviation * kMinDeviation ||
      variances.maxCoeff() > kMaxDeviation * kMaxDeviation) {
    throw std::invalid_argument("must have standard deviations in [1e-6, 1000] m and rad");
  }
  return symmetric;
}

}  // namespace credo
