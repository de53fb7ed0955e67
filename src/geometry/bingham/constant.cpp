#include "geometry/bingham/constant.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "geometry/bingham/scaled_bessel.hpp"

namespace credo {
namespace {

constexpr std::size_t kNodeCount = 32;
constexpr double kSphereArea = 2.0 * std::numbers::pi * std::numbers::pi;

struct Node {
  double place = 0.0;  // in (0, 1)
  double weight = 0.0;
};

/// Gauss-Legendre nodes: roots of the Legendre polynomial P of degree n, each found by Newton's
/// method from a near guess; the weights are 2 / ((1 - x^2) P'(x)^2).
std::array<Node, kNodeCount> gauss_legendre() {
  constexpr double n = kNodeCount;
  std::array<Node, kNodeCount> nodes;
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5));
    double slope = 0.0;
    for (int step = 0; step < 10; ++step) {
      double before = 1.0;
      double value = x;
      for (int k = 2; k <= static_cast<int>(kNodeCount); ++k) {
        double const next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n * (x * value - before) / (x * x - 1.0);
      x -= value / slope;
    }
    nodes[i] = {0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)};
  }
  return nodes;
}

/// F with its first and second derivatives.
struct Integral {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

/// The integrand at u, a share of the sphere: the circle of v1 and v2 has the squared radius u,
/// that of v3 and the mode 1 - u. Over a circle, exp of a quadratic form is a Bessel function.
void add_integrand(double u, double weight, Eigen::Vector3d const& z, Integral& sum) {
  double const a = 0.5 * u;
  double const b = 0.5 * (1.0 - u);
  ScaledBessel const first = scaled_bessel(a * (z[1] - z[0]));
  ScaledBessel const second = scaled_bessel(-b * z[2]);
  double const scale = weight * std::exp(u * z[1]);
  double const plus = first.zero + first.one;

  sum.value += scale * first.zero * second.zero;
  sum.gradient +=
      scale * Eigen::Vector3d(a * first.difference * second.zero, a * plus * second.zero,
                              b * first.zero * second.difference);
  Eigen::Matrix3d& H = sum.hessian;
  H(0, 0) += scale * a * a * (2.0 * first.difference - first.one_by_x) * second.zero;
  H(1, 1) += scale * a * a * (2.0 * plus - first.one_by_x) * second.zero;
  H(2, 2) += scale * b * b * (2.0 * second.difference - second.one_by_x) * first.zero;
  H(0, 1) += scale * a * a * first.one_by_x * second.zero;
  H(0, 2) += scale * a * b * first.difference * second.difference;
  H(1, 2) += scale * a * b * plus * second.difference;
}

void check(Eigen::Vector3d const& z) {
  if (!(std::isfinite(z[0]) && z[0] <= z[1] && z[1] <= z[2] && z[2] <= 0.0)) {
    std::ostringstream text;
    text << "bingham_constant: concentrations " << z.transpose() << " must ascend to 0 at most";
    throw std::logic_error(text.str());
  }
}

}  // namespace

BinghamConstant bingham_constant(Eigen::Vector3d const& concentrations) {
  static std::array<Node, kNodeCount> const nodes = gauss_legendre();
  check(concentrations);
  // Nodes are equal steps in the logarithm of u + 1 / (sum of the concentrations).
  double const stretch = std::log1p(-concentrations[0] - concentrations[2]);
  bool const plain = stretch < 1e-8;
  double const whole = std::expm1(stretch);
  Integral sum;
  for (Node const& node : nodes) {
    double const grown = std::expm1(stretch * node.place);
    double const u = plain ? node.place : grown / whole;
    double const step = plain ? 1.0 : stretch * (grown + 1.0) / whole;
    add_integrand(u, node.weight * step, concentrations, sum);
  }
  BinghamConstant result;
  result.log_F = std::log(sum.value);
  result.gradient = sum.gradient / sum.value;
  Eigen::Matrix3d const second =
      Eigen::Matrix3d(sum.hessian.selfadjointView<Eigen::Upper>()) / sum.value;
  result.hessian = second - result.gradient * result.gradient.transpose();
  return result;
}

double log_density(Bingham const& distribution, Eigen::Quaterniond const& rotation) {
  return distribution.log_ratio_to_mode(rotation) - std::log(kSphereArea) -
         bingham_constant(distribution.concentrations()).log_F;
}

double entropy(Bingham const& distribution) {
  BinghamConstant const constant = bingham_constant(distribution.concentrations());
  return std::log(kSphereArea) + constant.log_F -
         constant.gradient.dot(distribution.concentrations());
}

}  // namespace credo
