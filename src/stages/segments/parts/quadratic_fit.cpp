#include "stages/segments/parts/quadratic_fit.hpp"

#include <Eigen/Cholesky>
#include <cstddef>

namespace credo::segments {
namespace {

/// Of 0 to below n, the sums of the powers 0 to 4; exact up to a thousand.
std::array<double, 5> power_sums(double n) {
  double const triangle = n * (n - 1.0) / 2.0;
  double const pyramid = triangle * (2.0 * n - 1.0) / 3.0;
  return {n, triangle, pyramid, triangle * triangle, pyramid * (3.0 * n * n - 3.0 * n - 1.0) / 5.0};
}

}  // namespace

void QuadraticFit::add(int u, int v, std::span<double const> values) {
  auto const from = power_sums(u);
  auto const to = power_sums(u + static_cast<double>(values.size()));
  std::array<double, 3> of_values = {};
  for (std::size_t i = 0; i < values.size(); ++i) {
    double const at = u + static_cast<double>(i);
    of_values[0] += values[i];
    of_values[1] += at * values[i];
    of_values[2] += at * at * values[i];
  }
  double power_of_v = 1.0;
  for (std::size_t j = 0; j < 5; ++j) {
    for (std::size_t i = 0; i + j < 5; ++i) {
      moments_[i][j] += (to[i] - from[i]) * power_of_v;
    }
    for (std::size_t i = 0; i + j < 3; ++i) {
      products_[i][j] += of_values[i] * power_of_v;
    }
    power_of_v *= v;
  }
}

double QuadraticFit::bend(double over_px) const {
  // Powers of u and v.
  constexpr std::array<std::array<std::size_t, 2>, 6> kTerms = {
      {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};
  std::array<double, 5> scale = {1.0};
  for (std::size_t power = 1; power < scale.size(); ++power) {
    scale[power] = scale[power - 1] / over_px;
  }
  Eigen::Matrix<double, 6, 6> squares;
  Eigen::Matrix<double, 6, 1> products;
  for (std::size_t i = 0; i < kTerms.size(); ++i) {
    auto const [u, v] = kTerms[i];
    products[static_cast<Eigen::Index>(i)] = products_[u][v] * scale[u + v];
    for (std::size_t k = 0; k < kTerms.size(); ++k) {
      std::size_t const all_u = u + kTerms[k][0];
      std::size_t const all_v = v + kTerms[k][1];
      squares(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          moments_[all_u][all_v] * scale[all_u + all_v];
    }
  }
  Eigen::Matrix<double, 6, 1> const fit = squares.ldlt().solve(products);
  return 2.0 * (fit[3] + fit[5]);
}

}  // namespace credo::segments
