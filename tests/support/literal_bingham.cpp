#include "support/literal_bingham.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace credo::test {

using std::numbers::pi;

SphereIntegral literal_sphere_integral(Eigen::Matrix4d const& A) {
  constexpr int kTurns = 64;
  constexpr int kSteps = 300;
  SphereIntegral result;
  double weights = 0.0;
  for (int step = 0; step <= kSteps; ++step) {
    // Simpson's rule; the share u of the first circle is uniform on the sphere.
    double const u = static_cast<double>(step) / kSteps;
    double const weight = step == 0 || step == kSteps ? 1.0 : (step % 2 == 1 ? 4.0 : 2.0);
    for (int i = 0; i < kTurns; ++i) {
      for (int j = 0; j < kTurns; ++j) {
        double const first = 2.0 * pi * i / kTurns;
        double const second = 2.0 * pi * j / kTurns;
        Eigen::Vector4d const q(std::sqrt(u) * std::cos(first), std::sqrt(u) * std::sin(first),
                                std::sqrt(1.0 - u) * std::cos(second),
                                std::sqrt(1.0 - u) * std::sin(second));
        double const density = weight * std::exp(q.dot(A * q));
        weights += weight;
        result.F += density;
        result.scatter += density * q * q.transpose();
      }
    }
  }
  result.scatter /= result.F;
  result.F /= weights;
  return result;
}

Saddlepoint saddlepoint_constant(Eigen::Vector3d const& z) {
  Eigen::Array4d lambda;
  lambda << -z, 0.0;
  // sum 1 / (2 (lambda - t)) falls to 1 somewhere in [-2, -1/2].
  double low = -2.0;
  double high = -0.5;
  for (int halving = 0; halving < 100; ++halving) {
    double const t = 0.5 * (low + high);
    ((lambda - t).inverse().sum() > 2.0 ? high : low) = t;
  }
  Eigen::Array4d const apart = lambda - high;
  auto const cumulant = [&](int order, double factorial) {
    return 0.5 * factorial * apart.pow(-order).sum();
  };
  double const second = cumulant(2, 1.0);
  double const third = cumulant(3, 2.0) / std::pow(second, 1.5);
  double const fourth = cumulant(4, 6.0) / (second * second);
  Saddlepoint result;
  result.plain =
      std::sqrt(2.0) * std::pow(pi, 1.5) / std::sqrt(second * apart.prod()) * std::exp(-high);
  result.corrected = result.plain * std::exp(fourth / 8.0 - 5.0 * third * third / 24.0);
  return result;
}

double literal_1F1(double a, double b, double z) {
  double term = 1.0;
  double sum = 1.0;
  for (int k = 0; k < 2000 && term > 1e-20 * sum; ++k) {
    term *= (b - a + k) / (b + k) * -z / (k + 1);
    sum += term;
  }
  return std::exp(z) * sum;
}

LiteralBessel literal_bessel(double x) {
  // The trapezoid rule is exact to rounding on a smooth period once it resolves the peak.
  int const steps = 200 + static_cast<int>(40.0 * std::sqrt(x));
  LiteralBessel result;
  for (int i = 0; i < steps; ++i) {
    double const half = std::sin(pi * i / steps);
    double const less = 2.0 * half * half;  // 1 - cos
    double const value = std::exp(-x * less) / steps;
    result.zero += value;
    result.one += value * (1.0 - less);
    result.one_less += value * less;
  }
  return result;
}

}  // namespace credo::test
