#include "geometry/bingham/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/se3.hpp"
#include "geometry/bingham/constant.hpp"

namespace credo::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

Matrix4d skew_axes() {
  return left_product(wxyz(so3_exp({0.4, -1.1, 0.7}))) *
         right_product(wxyz(so3_exp({-0.9, 0.2, 1.3})));
}

// First and second moments of the squares along the axes are the first and second derivatives of
// ln F; off the diagonal the scatter is 0.
TEST(Sample, HasTheMomentsOfTheDistribution) {
  constexpr int kDraws = 100000;
  for (Vector3d const& z :
       {Vector3d(0, 0, 0), Vector3d(-3, -2, -1), Vector3d(-20, -20, -20), Vector3d(-100, -100, 0),
        Vector3d(-100, -100, -1), Vector3d(-900, -900, -900), Vector3d(-1e5, -300, -2)}) {
    Bingham const distribution(skew_axes(), z);
    BinghamConstant const constant = bingham_constant(z);
    std::mt19937_64 random(7);
    Matrix4d scatter = Matrix4d::Zero();
    Matrix3d squares = Matrix3d::Zero();
    for (int draw = 0; draw < kDraws; ++draw) {
      Vector4d const q = wxyz(sample(distribution, random));
      ASSERT_NEAR(q.norm(), 1.0, 1e-12);
      Vector4d const along = distribution.axes().transpose() * q;
      scatter += along * along.transpose() / kDraws;
      Vector3d const squared = along.head<3>().cwiseAbs2() - constant.gradient;
      squares += squared * squared.transpose() / kDraws;
    }
    Vector3d const error = constant.hessian.diagonal().cwiseSqrt() / std::sqrt(kDraws);
    EXPECT_LT(((scatter.diagonal().head<3>() - constant.gradient).array() / error.array())
                  .abs()
                  .maxCoeff(),
              4.0)
        << z.transpose();
    EXPECT_LT(
        ((squares - constant.hessian).diagonal().array() / constant.hessian.diagonal().array())
            .abs()
            .maxCoeff(),
        0.05)
        << z.transpose();
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        double const scale = std::sqrt(scatter(i, i) * scatter(j, j));
        EXPECT_NEAR(scatter(i, j) / scale, 0.0, 0.02) << z.transpose();
      }
    }
  }
}

// How many tries it takes is worked out from the constant: an envelope that is too wide would
// still draw right, but slowly, and one too tight wrong.
TEST(Sample, TakesTheShareOfTriesThatItMust) {
  struct Case {
    Vector3d z;
    double share;
  };
  for (Case const& one : {Case{{-900, -900, -900}, 0.447}, Case{{-100, -100, -1}, 0.653}}) {
    Bingham const distribution(skew_axes(), one.z);
    std::mt19937_64 random(9);
    std::mt19937_64 counter = random;
    constexpr int kDraws = 20000;
    for (int draw = 0; draw < kDraws; ++draw) {
      (void)sample(distribution, random);
    }
    int numbers = 0;
    for (; counter != random; counter.discard(1)) {
      ++numbers;
    }
    // A try is four normal numbers, of 2 draws in pi / 4 of the cases each, and a uniform one.
    double const tries = numbers / (4.0 * 2.0 * 4.0 / 3.14159265 + 1.0);
    EXPECT_NEAR(kDraws / tries, one.share, 0.01) << one.z.transpose();
  }
}

TEST(Sample, IsTheSameFromTheSameGenerator) {
  Bingham const distribution(skew_axes(), {-20, -10, -5});
  std::mt19937_64 random(3);
  std::mt19937_64 same(3);
  std::mt19937_64 other(4);
  auto const first = sample(distribution, random).coeffs();
  EXPECT_EQ(first, sample(distribution, same).coeffs());
  EXPECT_NE(first, sample(distribution, other).coeffs());
  EXPECT_NE(first, sample(distribution, random).coeffs());
}

}  // namespace
}  // namespace credo::test
