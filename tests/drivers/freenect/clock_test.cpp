#include "drivers/freenect/clock.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

namespace credo::freenect::test {
namespace {

constexpr std::uint64_t kWrap_us = 71'582'788;  // 2^32 / 60

/// The stamp of a time of the device.
std::uint32_t stamp_at(std::uint64_t time_us) {
  return static_cast<std::uint32_t>(time_us * 60);
}

TEST(ClockUnwrapper, BeginsAtTheFirstStamp) {
  ClockUnwrapper clock;
  EXPECT_EQ(clock.unwrap_us(6'000'000, 12'345), 100'000U);
}

// Frames of an hour: 50 wraps.
TEST(ClockUnwrapper, GoesOnThroughWraps) {
  ClockUnwrapper clock;
  constexpr std::uint64_t kFrame_us = 33'333;
  for (std::uint64_t time_us = 70'000'000; time_us < 3'670'000'000; time_us += kFrame_us) {
    ASSERT_EQ(clock.unwrap_us(stamp_at(time_us), static_cast<std::int64_t>(time_us) + 5'000),
              time_us);
  }
}

TEST(ClockUnwrapper, CountsWrapsOfAPauseByTheHost) {
  for (std::uint64_t const pause_us : {kWrap_us - 100'000, kWrap_us, 10 * kWrap_us + 40'000'000}) {
    ClockUnwrapper clock;
    clock.unwrap_us(stamp_at(1'000'000), 0);
    // The host's clock is a little off after so long.
    auto const host_us = static_cast<std::int64_t>(pause_us + pause_us / 10'000);
    EXPECT_EQ(clock.unwrap_us(stamp_at(1'000'000 + pause_us), host_us), 1'000'000 + pause_us);
  }
}

// Also where one is before the wrap and the other after it.
TEST(ClockUnwrapper, StreamsMayBeOutOfOrder) {
  for (std::uint64_t const start_us : {std::uint64_t{5'000'000}, kWrap_us + 10'000}) {
    ClockUnwrapper clock;
    clock.unwrap_us(stamp_at(start_us - 66'000), 0);
    EXPECT_EQ(clock.unwrap_us(stamp_at(start_us), 66'000), start_us);
    EXPECT_EQ(clock.unwrap_us(stamp_at(start_us - 33'000), 66'100), start_us - 33'000);
    EXPECT_EQ(clock.unwrap_us(stamp_at(start_us + 33'000), 99'000), start_us + 33'000);
  }
}

TEST(ClockUnwrapper, NothingIsBeforeTheOrigin) {
  ClockUnwrapper clock;
  EXPECT_EQ(clock.unwrap_us(stamp_at(10), 0), 10U);
  EXPECT_EQ(clock.unwrap_us(0U - 6'000U, 10), 0U);
}

// What waited in a queue while the host was busy.
TEST(ClockUnwrapper, LateStampsKeepTheirTime) {
  ClockUnwrapper clock;
  clock.unwrap_us(stamp_at(1'000'000), 0);
  EXPECT_EQ(clock.unwrap_us(stamp_at(1'033'333), 6'000'000), 1'033'333U);
  EXPECT_EQ(clock.unwrap_us(stamp_at(1'066'667), 6'001'000), 1'066'667U);
}

TEST(ClockUnwrapper, AResetDeviceGoesOnByTheHost) {
  ClockUnwrapper clock;
  clock.unwrap_us(stamp_at(50'000'000), 0);
  EXPECT_EQ(clock.unwrap_us(stamp_at(100), 2'000'000), 52'000'000U);
  EXPECT_EQ(clock.unwrap_us(stamp_at(33'433), 2'033'333), 52'033'333U);
}

// Less than a late stamp may be off, but streams do not overtake each other so far.
TEST(ClockUnwrapper, AResetSoonAfterTheStartGoesOnByTheHost) {
  ClockUnwrapper clock;
  clock.unwrap_us(stamp_at(5'000'000), 0);
  EXPECT_EQ(clock.unwrap_us(stamp_at(100), 33'333), 5'033'333U);
}

// Not step by step either.
TEST(ClockUnwrapper, NothingIsMoreThanASecondBehindTheNewest) {
  ClockUnwrapper clock;
  clock.unwrap_us(stamp_at(10'000'000), 0);
  EXPECT_EQ(clock.unwrap_us(stamp_at(9'400'000), 100), 9'400'000U);
  EXPECT_EQ(clock.unwrap_us(stamp_at(8'800'000), 200), 10'000'200U);
}

TEST(ClockUnwrapper, AJumpAheadIsNoTimeEither) {
  ClockUnwrapper clock;
  clock.unwrap_us(stamp_at(1'000'000), 0);
  EXPECT_EQ(clock.unwrap_us(stamp_at(21'000'000), 33'333), 1'033'333U);
  EXPECT_EQ(clock.unwrap_us(stamp_at(21'033'333), 66'666), 1'066'666U);
}

}  // namespace
}  // namespace credo::freenect::test
