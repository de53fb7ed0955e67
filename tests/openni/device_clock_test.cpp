#include "openni/device_clock.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <optional>

namespace credo {
namespace {

using std::chrono::microseconds;

constexpr std::uint64_t kFrame_us = 33'333;

/// A sensor that takes 30 images a second, which come as soon as they are taken.
class Ticks {
public:
  /// The time of the next image, by a stamp that is off by so much.
  std::int64_t next(std::int64_t off_us = 0, std::int64_t late_us = 0) {
    true_us_ += kFrame_us;
    return clock_.time_ns(static_cast<std::uint64_t>(static_cast<std::int64_t>(true_us_) + off_us),
                          at(late_us));
  }
  /// What the next image's time is off by.
  std::int64_t error_of_next(std::int64_t off_us = 0, std::int64_t late_us = 0) {
    std::int64_t const time_ns = next(off_us, late_us);
    return time_ns - true_ns();
  }
  /// A second stream's, taken with the last one.
  [[nodiscard]] std::int64_t beside(std::int64_t off_us = 0) const {
    return clock_.following_time_ns(
        static_cast<std::uint64_t>(static_cast<std::int64_t>(true_us_) + off_us), at(0));
  }
  void pass_us(std::uint64_t us) { true_us_ += us; }
  [[nodiscard]] std::int64_t true_ns() const { return static_cast<std::int64_t>(true_us_) * 1000; }
  DeviceClock& clock() { return clock_; }

private:
  [[nodiscard]] DeviceClock::HostTime at(std::int64_t late_us) const {
    return DeviceClock::HostTime() + microseconds(true_us_) + microseconds(late_us);
  }

  DeviceClock clock_;
  std::uint64_t true_us_ = 10'000'000;
};

TEST(DeviceClock, StampsStandAsTheyAreWhileTheyFit) {
  Ticks ticks;
  for (int i = 0; i < 100; ++i) {
    // Up to half a second late, and then several at once.
    ASSERT_EQ(ticks.error_of_next(0, i % 10 == 9 ? 0 : (i % 10) * 30'000), 0);
  }
  EXPECT_EQ(ticks.clock().jumps(), 0U);
}

TEST(DeviceClock, ALongSilenceIsNoJump) {
  Ticks ticks;
  ticks.next();
  ticks.pass_us(3'600'000'000);
  EXPECT_EQ(ticks.error_of_next(), 0);
  EXPECT_EQ(ticks.clock().jumps(), 0U);
}

TEST(DeviceClock, AWrapIsKnownExactly) {
  constexpr std::int64_t kWrap_ns = 71'582'788'267;
  Ticks ticks;
  ticks.next();
  // Stamps are whole microseconds, a wrap is not.
  EXPECT_EQ(ticks.error_of_next(-kWrap_ns / 1000, 4'000), kWrap_ns % 1000);
  EXPECT_EQ(ticks.error_of_next(-kWrap_ns / 1000), kWrap_ns % 1000);
  EXPECT_EQ(ticks.clock().jumps(), 0U);
}

TEST(DeviceClock, AfterAJumpTimeGoesOnByTheHostsClock) {
  for (std::int64_t const jump_us :
       std::initializer_list<std::int64_t>{-500'000, -9'000'000, 600'000, 3'600'000'000}) {
    Ticks ticks;
    ticks.next();
    EXPECT_EQ(ticks.error_of_next(jump_us), 0) << jump_us;
    EXPECT_EQ(ticks.error_of_next(jump_us), 0) << jump_us;
    EXPECT_EQ(ticks.clock().jumps(), 1U) << jump_us;
  }
}

// Where the host's clock has not moved either, or an image comes twice.
TEST(DeviceClock, TimeAlwaysGrows) {
  DeviceClock clock;
  DeviceClock::HostTime const now;
  std::int64_t const first = clock.time_ns(1000, now);
  std::int64_t const again = clock.time_ns(1000, now);
  EXPECT_GT(again, first);
  EXPECT_GT(clock.time_ns(0, now), again);
}

TEST(DeviceClock, ARestartIsNoJumpAndTimeGoesOn) {
  Ticks ticks;
  ticks.next();
  ticks.clock().restart();
  ticks.pass_us(5'000'000);
  EXPECT_EQ(ticks.error_of_next(-10'000'000), 0);
  EXPECT_EQ(ticks.error_of_next(-10'000'000), 0);
  EXPECT_EQ(ticks.clock().jumps(), 0U);
}

TEST(DeviceClock, AnotherStreamFollows) {
  Ticks ticks;
  EXPECT_EQ(ticks.beside(), ticks.true_ns());
  ticks.next();
  EXPECT_EQ(ticks.beside(), ticks.true_ns());
  // Its own shift is no jump of the clock.
  EXPECT_EQ(ticks.beside(-400'000), ticks.true_ns() - 400'000'000);
  ticks.next(600'000);
  EXPECT_EQ(ticks.beside(600'000), ticks.true_ns());
  // Taken before the jump.
  EXPECT_EQ(ticks.beside(0), ticks.true_ns());
}

}  // namespace
}  // namespace credo
