#include "geometry/random_draws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace credo::test {
namespace {

// The standard fixes the generator's numbers: its 10000th, from the default seed, is
// 9981545732273789042.
TEST(DrawUniform, IsTheGeneratorsNumberWhateverTheLibrary) {
  std::mt19937_64 random(5489);
  random.discard(9999);
  double const expected = std::ldexp(std::floor(std::ldexp(9981545732273789042.0, -12)) + 0.5, -52);
  EXPECT_EQ(draw_uniform(random), expected);
}

/// Largest distance of the draws' distribution function from another (Kolmogorov and Smirnov),
/// times the root of their number.
template <typename Function>
double distance_from(std::vector<double> draws, Function const& distribution) {
  std::ranges::sort(draws);
  double worst = 0.0;
  auto const count = static_cast<double>(draws.size());
  for (std::size_t i = 0; i < draws.size(); ++i) {
    double const expected = distribution(draws[i]);
    worst = std::max({worst, expected - static_cast<double>(i) / count,
                      static_cast<double>(i + 1) / count - expected});
  }
  return worst * std::sqrt(count);
}

TEST(DrawUniform, IsUniformAndNeverZeroOrOne) {
  std::mt19937_64 random(1);
  std::vector<double> draws(100000);
  for (double& draw : draws) {
    draw = draw_uniform(random);
  }
  EXPECT_GT(*std::ranges::min_element(draws), 0.0);
  EXPECT_LT(*std::ranges::max_element(draws), 1.0);
  // One sample in a thousand is above 1.95.
  EXPECT_LT(distance_from(draws, [](double x) { return x; }), 1.95);
}

TEST(DrawNormal, IsNormal) {
  std::mt19937_64 random(2);
  std::vector<double> draws(200000);
  for (double& draw : draws) {
    draw = draw_normal(random);
  }
  auto const normal = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  EXPECT_LT(distance_from(draws, normal), 1.95);
}

TEST(DrawNormal, HasNoMemoryBesideTheGenerator) {
  std::mt19937_64 random(3);
  (void)draw_normal(random);
  std::mt19937_64 same = random;
  EXPECT_EQ(draw_normal(random), draw_normal(same));
  EXPECT_EQ(random, same);
}

}  // namespace
}  // namespace credo::test
