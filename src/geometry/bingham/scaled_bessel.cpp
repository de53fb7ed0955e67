#include "geometry/bingham/scaled_bessel.hpp"

#include <cmath>
#include <numbers>

namespace credo {
namespace {

constexpr double kNegligible = 1e-17;

/// I0 = sum (x/2)^2k / k!^2 and I1 = x/2 sum (x/2)^2k / (k! (k+1)!): all terms positive.
ScaledBessel by_powers(double x) {
  double const quarter = 0.25 * x * x;
  double term = 1.0;
  double zero = 1.0;
  double one_by_half_x = 1.0;
  for (int k = 1; term > kNegligible * zero; ++k) {
    term *= quarter / (k * k);
    zero += term;
    one_by_half_x += term / (k + 1);
  }
  double const scale = std::exp(-x);
  double const one = 0.5 * x * one_by_half_x;
  return {scale * zero, scale * one, scale * (zero - one), 0.5 * scale * one_by_half_x};
}

/// Hankel's expansion: the terms of order n are products of ((2k-1)^2 - 4 n^2) / (8 k x).
ScaledBessel by_inverse_powers(double x) {
  double term_zero = 1.0;
  double term_one = 1.0;
  double zero = 1.0;
  double difference = 0.0;
  for (int k = 1; std::abs(term_one) > kNegligible; ++k) {
    double const odd = 2 * k - 1;
    term_zero *= odd * odd / (8.0 * k * x);
    term_one *= (odd * odd - 4.0) / (8.0 * k * x);
    zero += term_zero;
    difference += term_zero - term_one;
  }
  double const scale = 1.0 / std::sqrt(2.0 * std::numbers::pi * x);
  double const one = scale * (zero - difference);
  return {scale * zero, one, scale * difference, one / x};
}

}  // namespace

ScaledBessel scaled_bessel(double x) {
  constexpr double kManyTerms = 20.0;
  return x < kManyTerms ? by_powers(x) : by_inverse_powers(x);
}

}  // namespace credo
