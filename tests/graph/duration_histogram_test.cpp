#include "graph/duration_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

namespace credo {
namespace {

using std::chrono::nanoseconds;

TEST(DurationHistogram, IsZeroWithoutSamples) {
  DurationHistogram const histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.quantile_ms(0.5), 0.0);
  EXPECT_EQ(histogram.max_ms(), 0.0);
}

TEST(DurationHistogram, QuantilesAreWithinOnePercentOfTheSortedSamples) {
  std::mt19937 random(7);
  std::lognormal_distribution<double> spread(1.0, 1.5);
  DurationHistogram histogram;
  std::vector<double> samples;
  for (int i = 0; i < 5000; ++i) {
    nanoseconds const sample(static_cast<std::int64_t>(spread(random) * 1e6));
    histogram.add(sample);
    samples.push_back(static_cast<double>(sample.count()) * 1e-6);
  }
  std::sort(samples.begin(), samples.end());
  for (double q : {0.01, 0.5, 0.95, 0.99, 1.0}) {
    double const exact = samples[static_cast<std::size_t>(std::ceil(q * 5000.0)) - 1];
    EXPECT_GE(histogram.quantile_ms(q), exact * 0.999) << q;
    EXPECT_LE(histogram.quantile_ms(q), exact * 1.0101) << q;
  }
  EXPECT_EQ(histogram.max_ms(), samples.back());
  EXPECT_EQ(histogram.count(), 5000U);
}

TEST(DurationHistogram, TakesWhatLiesOutsideIntoItsEnds) {
  DurationHistogram histogram;
  histogram.add(nanoseconds(-5));
  EXPECT_EQ(histogram.max_ms(), 0.0);
  EXPECT_EQ(histogram.quantile_ms(1.0), 0.0);
  histogram.add(std::chrono::hours(1));
  EXPECT_EQ(histogram.max_ms(), 3.6e6);
  EXPECT_GE(histogram.quantile_ms(1.0), 1e6);
}

}  // namespace
}  // namespace credo
