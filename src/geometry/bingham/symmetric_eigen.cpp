#include "geometry/bingham/symmetric_eigen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace credo {
namespace {

/// The matrix on its way to a diagonal one, upper triangle only, and the rotations so far.
struct Progress {
  std::array<std::array<double, 4>, 4> a;
  /// One vector a row.
  std::array<std::array<double, 4>, 4> vectors;

  double& at(std::size_t i, std::size_t j) { return i < j ? a[i][j] : a[j][i]; }
};

/// Turns axes p and q, and leaves no A_pq (Golub and Van Loan, 8.5).
template <std::size_t p, std::size_t q, std::size_t r, std::size_t s>
void rotate(Progress& on) {
  double const apart = on.a[q][q] - on.a[p][p];
  double const twice = 2.0 * on.a[p][q];
  // (cosine, sine) of the lesser of two angles go as (wide, high). The least number makes a zero
  // matrix turn by nothing.
  constexpr double kLeast = 1e-150;
  double const wide = std::abs(apart) + std::sqrt(apart * apart + twice * twice) + kLeast;
  double const high = std::signbit(apart) ? -twice : twice;
  double const scale = 1.0 / std::sqrt(wide * wide + high * high);
  double const cosine = wide * scale;
  double const sine = high * scale;
  double const moved = high / wide * on.a[p][q];
  on.a[p][p] -= moved;
  on.a[q][q] += moved;
  on.a[p][q] = 0.0;
  for (std::size_t const other : {r, s}) {
    double& first = on.at(p, other);
    double& second = on.at(q, other);
    double const before = first;
    first = cosine * before - sine * second;
    second = sine * before + cosine * second;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    double const before = on.vectors[p][i];
    on.vectors[p][i] = cosine * before - sine * on.vectors[q][i];
    on.vectors[q][i] = sine * before + cosine * on.vectors[q][i];
  }
}

double largest_beside_diagonal(Progress const& on) {
  auto const& a = on.a;
  return std::max({std::abs(a[0][1]), std::abs(a[0][2]), std::abs(a[0][3]), std::abs(a[1][2]),
                   std::abs(a[1][3]), std::abs(a[2][3])});
}

}  // namespace

SymmetricEigen symmetric_eigen(Eigen::Matrix4d const& A) {
  Progress on{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      on.a[i][j] = A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
    on.vectors[i][i] = 1.0;
  }
  // Each sweep squares what is left: what a last one leaves is below rounding.
  double const negligible = 1e-16 * A.cwiseAbs().maxCoeff();
  constexpr int kMostSweeps = 12;
  for (int sweep = 0; sweep < kMostSweeps && largest_beside_diagonal(on) > negligible; ++sweep) {
    rotate<0, 1, 2, 3>(on);
    rotate<2, 3, 0, 1>(on);
    rotate<0, 2, 1, 3>(on);
    rotate<1, 3, 0, 2>(on);
    rotate<0, 3, 1, 2>(on);
    rotate<1, 2, 0, 3>(on);
  }
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  // Equal values stay in their order; a stable sort would allocate.
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(on.a[i][i], i); });
  SymmetricEigen result;
  for (std::size_t k = 0; k < 4; ++k) {
    auto const column = static_cast<Eigen::Index>(k);
    result.values[column] = on.a[order[k]][order[k]];
    result.vectors.col(column) = Eigen::Vector4d::Map(on.vectors[order[k]].data());
  }
  return result;
}

}  // namespace credo
