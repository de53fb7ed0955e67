#include "geometry/bingham/fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/bingham/constant.hpp"
#include "geometry/bingham/symmetric_eigen.hpp"

namespace credo {
namespace {

/// Ascending, within what may be fitted. Its order is the wanted moments' own: a step that breaks
/// it went too far.
Eigen::Vector3d allowed(Eigen::Vector3d z) {
  z = z.cwiseMax(kLeastFittedConcentration).cwiseMin(0.0);
  std::ranges::sort(z);
  return z;
}

/// Concentrations at the bound that want to pass it: they stay, and the others move alone.
Eigen::Array3d free_ones(Eigen::Vector3d const& z, Eigen::Vector3d const& rise) {
  return (z.array() <= kLeastFittedConcentration && rise.array() <= 0.0)
      .select(Eigen::Array3d::Zero(), Eigen::Array3d::Ones());
}

/// Newton's step up the likelihood z . moments - ln F(z), whose slope is `rise`.
Eigen::Vector3d newton_step(Eigen::Matrix3d hessian, Eigen::Vector3d const& rise,
                            Eigen::Array3d const& free) {
  for (int i = 0; i < 3; ++i) {
    if (free[i] == 0.0) {
      hessian.row(i).setZero();
      hessian.col(i).setZero();
      hessian(i, i) = 1.0;
    }
  }
  return hessian.ldlt().solve((rise.array() * free).matrix());
}

/// Concentrations whose E[(v_i . q)^2] are `moments`, ascending, 1/4 at most on average: the
/// likelihood is concave, and the start is right in the limit of high concentration.
Eigen::Vector3d concentrations_of(Eigen::Vector3d const& moments) {
  constexpr double kPrecision = 1e-12;
  constexpr double kLeastMoment = 1e-9;
  Eigen::Vector3d const told = moments.cwiseMax(kLeastMoment);
  Eigen::Vector3d z = allowed(-0.5 * told.cwiseInverse());
  BinghamConstant constant = bingham_constant(z);
  for (int step = 0; step < 50; ++step) {
    Eigen::Vector3d const rise = told - constant.gradient;
    Eigen::Array3d const free = free_ones(z, rise);
    if ((rise.array() * free / told.array()).abs().maxCoeff() < kPrecision) {
      break;
    }
    Eigen::Vector3d const move = newton_step(constant.hessian, rise, free);
    double const likelihood = z.dot(told) - constant.log_F;
    Eigen::Vector3d const start = z;
    // Halved until it goes up; rounding alone must not stop it.
    double const least = likelihood - 1e-13 * (1.0 + std::abs(likelihood));
    for (double share = 1.0; share > 1e-6; share *= 0.5) {
      z = allowed(start + share * move);
      constant = bingham_constant(z);
      if (z.dot(told) - constant.log_F >= least) {
        break;
      }
    }
  }
  return z;
}

}  // namespace

Eigen::Matrix4d scatter_of(Bingham const& distribution) {
  Eigen::Vector3d const moments = bingham_constant(distribution.concentrations()).gradient;
  Eigen::Vector4d all;
  all << moments, 1.0 - moments.sum();
  return distribution.axes() * all.asDiagonal() * distribution.axes().transpose();
}

Bingham fit_to_scatter(Eigen::Matrix4d const& scatter) {
  double const trace = scatter.trace();
  if (!scatter.allFinite() || !(trace > 0.0)) {
    throw std::logic_error("fit_to_scatter: not a scatter matrix, its trace is " +
                           std::to_string(trace));
  }
  SymmetricEigen const parts = symmetric_eigen((scatter + scatter.transpose()) / (2.0 * trace));
  return {parts.vectors, concentrations_of(parts.values.head<3>())};
}

Bingham fit_bingham(std::span<Eigen::Quaterniond const> rotations,
                    std::span<double const> weights) {
  if (rotations.size() != weights.size()) {
    throw std::logic_error("fit_bingham: " + std::to_string(rotations.size()) + " rotations but " +
                           std::to_string(weights.size()) + " weights");
  }
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  double total = 0.0;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    if (!(weights[i] >= 0.0)) {
      throw std::logic_error("fit_bingham: weight " + std::to_string(weights[i]) + " of rotation " +
                             std::to_string(i) + " must be 0 or more");
    }
    Eigen::Vector4d const q = wxyz(rotations[i]);
    sum += weights[i] * q * q.transpose();
    total += weights[i];
  }
  return total == 0.0 ? Bingham{} : fit_to_scatter(sum);
}

Bingham fit_bingham(std::span<Eigen::Quaterniond const> rotations) {
  std::vector<double> const ones(rotations.size(), 1.0);
  return fit_bingham(rotations, ones);
}

Bingham composition(Bingham const& a, Bingham const& b) {
  Eigen::Matrix4d const of_a = scatter_of(a);
  Eigen::Matrix4d const of_b = scatter_of(b);
  // a (x) b is the sum over k of a_k L_k b, L_k being the product with the k-th unit.
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l < 4; ++l) {
      sum += of_a(k, l) * left_product(Eigen::Vector4d::Unit(k)) * of_b *
             left_product(Eigen::Vector4d::Unit(l)).transpose();
    }
  }
  return fit_to_scatter(sum);
}

}  // namespace credo
