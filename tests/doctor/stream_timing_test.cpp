#include "doctor/stream_timing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "doctor/image_times.hpp"

namespace credo::test {
namespace {

TEST(StreamTiming, OfImagesInTime) {
  StreamTiming const timing = timing_of(image_times(30.0, 91));
  EXPECT_EQ(timing.images, 91);
  EXPECT_EQ(timing.lost, 0);
  EXPECT_NEAR(timing.rate_by_stamp_hz, 30.0, 1e-6);
  EXPECT_NEAR(timing.rate_by_arrival_hz, 30.0, 1e-6);
  EXPECT_NEAR(timing.longest_gap_s, 1.0 / 30.0, 1e-6);
}

TEST(StreamTiming, OfNoneAndOne) {
  for (int images : {0, 1}) {
    StreamTiming const timing = timing_of(image_times(30.0, images));
    EXPECT_EQ(timing.images, images);
    EXPECT_EQ(timing.lost, 0);
    EXPECT_EQ(timing.rate_by_stamp_hz, 0.0);
    EXPECT_EQ(timing.rate_by_arrival_hz, 0.0);
  }
}

TEST(StreamTiming, CountsWhatIsMissingByNumber) {
  std::vector<ImageTime> images = image_times(30.0, 31);
  images.erase(images.begin() + 10, images.begin() + 13);
  images.erase(images.begin() + 20);
  StreamTiming const timing = timing_of(images);
  EXPECT_EQ(timing.images, 27);
  EXPECT_EQ(timing.lost, 4);
  EXPECT_NEAR(timing.rate_by_arrival_hz, 26.0, 1e-6);
  EXPECT_NEAR(timing.longest_gap_s, 4.0 / 30.0, 1e-6);
  // A stream that was started anew counts from the first again.
  images.back().number = 0;
  EXPECT_EQ(timing_of(images).lost, 4);
}

TEST(StreamTiming, StampsAndArrivalsMayDiffer) {
  std::vector<ImageTime> images = image_times(30.0, 31);
  for (std::size_t i = 0; i < images.size(); ++i) {
    images[i].stamp_ns *= 2;
  }
  EXPECT_NEAR(timing_of(images).rate_by_stamp_hz, 15.0, 1e-6);
  EXPECT_NEAR(timing_of(images).rate_by_arrival_hz, 30.0, 1e-6);
}

TEST(StreamSync, OfColourThatComesLater) {
  auto const sync = sync_of(image_times(30.0, 90), shifted(image_times(30.0, 90), 12.0), 30.0);
  ASSERT_TRUE(sync);
  EXPECT_NEAR(sync->median_ms, 12.0, 1e-3);
  EXPECT_NEAR(sync->worst_ms, 12.0, 1e-3);
  EXPECT_EQ(sync->paired_share, 1.0);
}

// By more than half a frame's time: the one before is nearer.
TEST(StreamSync, OfTheNearest) {
  auto const sync = sync_of(image_times(30.0, 90), shifted(image_times(30.0, 90), 25.0), 30.0);
  ASSERT_TRUE(sync);
  EXPECT_NEAR(sync->median_ms, 25.0 - 1000.0 / 30.0, 1e-3);
}

TEST(StreamSync, OfColourAtATenthOfTheRate) {
  auto const sync = sync_of(image_times(30.0, 91), image_times(3.0, 10), 30.0);
  ASSERT_TRUE(sync);
  EXPECT_NEAR(sync->paired_share, 10.0 / 91.0, 0.01);
  EXPECT_NEAR(std::abs(sync->worst_ms), 5000.0 / 30.0, 0.1);
}

TEST(StreamSync, OfTheTimeInWhichBothCame) {
  std::vector<ImageTime> color = image_times(30.0, 90);
  color.erase(color.begin(), color.begin() + 60);
  auto const sync = sync_of(image_times(30.0, 90), color, 30.0);
  ASSERT_TRUE(sync);
  EXPECT_EQ(sync->paired_share, 1.0);
  EXPECT_FALSE(sync_of(image_times(30.0, 90), {}, 30.0));
  EXPECT_FALSE(sync_of({}, color, 30.0));
  EXPECT_FALSE(sync_of(image_times(30.0, 10), color, 30.0));
}

TEST(ClockDrift, OfATrueClockAndOneThatIsNot) {
  for (double const ppm : {0.0, 5000.0, -5000.0}) {
    std::vector<ImageTime> images = image_times(30.0, 91);
    for (ImageTime& image : images) {
      image.stamp_ns += std::llround(static_cast<double>(image.stamp_ns) * 1e-6 * ppm);
    }
    auto const drift = drift_of(images);
    ASSERT_TRUE(drift);
    EXPECT_NEAR(drift->ppm, ppm, 0.1);
    EXPECT_NEAR(drift->change_ms, 1e-3 * ppm * 2.0, 0.2 * std::abs(1e-3 * ppm * 2.0) + 1e-3);
  }
}

// Most images late, at random, and more so at the end: the few that are not tell.
TEST(ClockDrift, IsNotFooledByImagesThatComeLate) {
  std::vector<ImageTime> images = image_times(30.0, 91);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (i % 10 != 0) {
      images[i].arrival += std::chrono::microseconds(i * 997 % 5000 + i * 100);
    }
  }
  auto const drift = drift_of(images);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->ppm, 0.0, 1e-3);
}

TEST(ClockDrift, OfTooFew) {
  EXPECT_FALSE(drift_of(image_times(30.0, 8)));
  EXPECT_FALSE(drift_of(image_times(30.0, 29)));  // in less than a second
  EXPECT_FALSE(drift_of(image_times(1.0, 5)));
}

}  // namespace
}  // namespace credo::test
