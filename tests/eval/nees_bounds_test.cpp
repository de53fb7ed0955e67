#include "eval/nees_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace credo {
namespace {

Matrix6d diagonal(double variance) {
  return variance * Matrix6d::Identity();
}

TEST(RepeatedClaims, OfNoneAreWorthNone) {
  EXPECT_EQ(RepeatedClaims().worth(), 0.0);
}

TEST(RepeatedClaims, AboutManyObjectsAreIndependent) {
  RepeatedClaims claims;
  claims.add("a", diagonal(1.0), 6);
  claims.add("b", diagonal(0.1), 6);
  claims.add("c", diagonal(0.1), 6);
  EXPECT_NEAR(claims.worth(), 3.0, 1e-12);
  NeesBounds const one_by_one = nees_bounds(18.0, 3);
  NeesBounds const all = nees_bounds_of(6.0, claims.worth());
  EXPECT_NEAR(all.low, one_by_one.low, 1e-12);
  EXPECT_NEAR(all.high, one_by_one.high, 1e-12);
}

TEST(RepeatedClaims, OfWhichNothingIsLearntAreWorthOne) {
  RepeatedClaims claims;
  RepeatedClaims symmetric;
  for (int i = 0; i < 50; ++i) {
    claims.add("a", diagonal(0.01), 6);
    symmetric.add("a", diagonal(0.01), 5);
  }
  EXPECT_NEAR(claims.worth(), 1.0, 1e-9);
  EXPECT_NEAR(symmetric.worth(), 1.0, 1e-9);
}

TEST(RepeatedClaims, ThatGrowVagueAgainRepeatNoMoreThanAll) {
  RepeatedClaims claims;
  claims.add("a", diagonal(0.01), 6);
  claims.add("a", diagonal(1.0), 6);
  EXPECT_NEAR(claims.worth(), 1.0, 1e-12);
}

// A mean of so many looks as there were: 19 of 20 such runs must have their mean within the bounds,
// of which the ones for independent claims hold no more than half.
TEST(RepeatedClaims, BoundTheMeanOfAFilterThatLearns) {
  constexpr int kRuns = 2000;
  constexpr int kFrames = 40;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int inside = 0;
  int inside_independent = 0;
  for (int run = 0; run < kRuns; ++run) {
    RepeatedClaims claims;
    Vector6d sum = Vector6d::Zero();
    double nees = 0.0;
    for (int n = 1; n <= kFrames; ++n) {
      sum += Vector6d::NullaryExpr([&] { return normal(random); });
      nees += (sum / n).squaredNorm() * n / kFrames;
      claims.add("a", diagonal(1.0 / n), 6);
    }
    NeesBounds const bounds = nees_bounds_of(6.0, claims.worth());
    inside += bounds.low < nees && nees < bounds.high ? 1 : 0;
    NeesBounds const independent = nees_bounds(6.0 * kFrames, kFrames);
    inside_independent += independent.low < nees && nees < independent.high ? 1 : 0;
  }
  EXPECT_NEAR(inside, 0.95 * kRuns, 0.02 * kRuns);
  EXPECT_LT(inside_independent, kRuns / 2);
}

}  // namespace
}  // namespace credo
