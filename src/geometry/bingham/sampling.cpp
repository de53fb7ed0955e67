#include "geometry/bingham/sampling.hpp"

#include <Eigen/Core>
#include <cmath>

#include "geometry/random_draws.hpp"

namespace credo {
namespace {

/// The solution b in [1, 4] of sum 1 / (b + 2 lambda_i) = 1, which makes the envelope tightest. The
/// sum is convex and falls: Newton's steps from 1 go up and never beyond.
double envelope(Eigen::Array4d const& lambda) {
  double b = 1.0;
  for (int step = 0; step < 50; ++step) {
    Eigen::Array4d const terms = (b + 2.0 * lambda).inverse();
    double const move = (terms.sum() - 1.0) / terms.square().sum();
    b += move;
    if (move < 1e-14) {
      break;
    }
  }
  return b;
}

}  // namespace

Eigen::Quaterniond sample(Bingham const& distribution, std::mt19937_64& random) {
  Eigen::Array4d lambda;
  lambda << -distribution.concentrations(), 0.0;
  double const b = envelope(lambda);
  Eigen::Array4d const omega = 1.0 + 2.0 / b * lambda;
  Eigen::Array4d const deviation = omega.rsqrt();
  double const bound = 0.5 * (4.0 - b) + 2.0 * std::log(0.25 * b);
  while (true) {
    Eigen::Array4d y;
    for (double& value : y) {
      value = draw_normal(random);
    }
    y *= deviation;
    Eigen::Array4d const squared = y.square() / y.square().sum();
    double const log_share =
        bound - (lambda * squared).sum() + 2.0 * std::log((omega * squared).sum());
    if (std::log(draw_uniform(random)) < log_share) {
      return quaternion_of(distribution.axes() * y.matrix().normalized());
    }
  }
}

}  // namespace credo
