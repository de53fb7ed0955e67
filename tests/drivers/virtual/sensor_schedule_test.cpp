#include "drivers/virtual/sensor_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <vector>

namespace credo::test {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr auto kDepth = SensorStream::kDepth;
constexpr auto kColor = SensorStream::kColor;

SensorSchedule with(Fault const& fault) {
  SensorScript script;
  script.faults = {fault};
  return SensorSchedule(script, 100);
}

/// Ticks below 100 at which a stream hands out nothing.
std::set<std::int64_t> missing(SensorSchedule const& schedule, SensorStream stream) {
  std::set<std::int64_t> ticks;
  for (std::int64_t tick = 0; tick < 100; ++tick) {
    if (!schedule.at(stream, tick)) {
      ticks.insert(tick);
    }
  }
  return ticks;
}

std::vector<std::size_t> order(PlayMode play, std::size_t images, std::int64_t ticks) {
  SensorScript script;
  script.play = play;
  SensorSchedule const schedule(script, images);
  std::vector<std::size_t> shown;
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    if (auto const image = schedule.at(kDepth, tick)) {
      shown.push_back(image->image);
    }
  }
  return shown;
}

TEST(SensorSchedule, PlaysInItsOrder) {
  EXPECT_THAT(order(PlayMode::kLoop, 3, 7), ElementsAre(0, 1, 2, 0, 1, 2, 0));
  EXPECT_THAT(order(PlayMode::kPingPong, 3, 7), ElementsAre(0, 1, 2, 1, 0, 1, 2));
  EXPECT_THAT(order(PlayMode::kPingPong, 2, 4), ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(order(PlayMode::kPingPong, 1, 3), ElementsAre(0, 0, 0));
  EXPECT_THAT(order(PlayMode::kOnce, 3, 7), ElementsAre(0, 1, 2));
  EXPECT_THROW(SensorSchedule({}, 0), std::logic_error);
}

TEST(SensorSchedule, WithoutFaultsBothStreamsComeAtEachTick) {
  SensorSchedule const schedule({}, 100);
  for (std::int64_t tick = 0; tick < 1000; ++tick) {
    ScheduledImage const expected{
        .image = static_cast<std::size_t>(tick % 100),
        .stamp_us = static_cast<std::uint64_t>(1'000'000 + tick * 1'000'000 / 30)};
    ASSERT_EQ(schedule.at(kDepth, tick), expected) << tick;
    ASSERT_EQ(schedule.at(kColor, tick), expected) << tick;
  }
  EXPECT_EQ(schedule.plug_state(0), (PlugState{true, 0}));
}

TEST(SensorSchedule, StreamsOfDifferentRatesShowTheSameTime) {
  SensorScript script;
  script.color_rate_hz = 20;
  SensorSchedule const schedule(script, 100);
  // 0, 50, 100, 150 ms: the depth images of 0, 33 or 67, 100, 133 or 167 ms.
  EXPECT_EQ(schedule.at(kColor, 0)->image, 0U);
  EXPECT_EQ(schedule.at(kColor, 1)->image, 2U);
  EXPECT_EQ(schedule.at(kColor, 2)->image, 3U);
  EXPECT_EQ(schedule.at(kColor, 1)->stamp_us, 1'050'000U);
  EXPECT_EQ(schedule.at(kDepth, 3)->stamp_us, schedule.at(kColor, 2)->stamp_us);
}

TEST(SensorSchedule, AStallHoldsItsStreamsBack) {
  Fault fault{.kind = FaultKind::kStall,
              .from_ns = tick_time_ns(10, 30),
              .until_ns = tick_time_ns(13, 30),
              .color = false};
  EXPECT_THAT(missing(with(fault), kDepth), ElementsAre(10, 11, 12));
  EXPECT_THAT(missing(with(fault), kColor), ElementsAre());
  fault.color = true;
  fault.depth = false;
  EXPECT_THAT(missing(with(fault), kDepth), ElementsAre());
  EXPECT_THAT(missing(with(fault), kColor), ElementsAre(10, 11, 12));
}

TEST(SensorSchedule, ARateFaultLeavesOneOfSoMany) {
  Fault const fault{
      .kind = FaultKind::kRate, .from_ns = tick_time_ns(90, 30), .color = false, .every = 3};
  EXPECT_THAT(missing(with(fault), kDepth), ElementsAre(91, 92, 94, 95, 97, 98));
  EXPECT_THAT(missing(with(fault), kColor), ElementsAre());
}

TEST(SensorSchedule, DropsAShareTheSameEveryTime) {
  Fault fault{.kind = FaultKind::kDrop, .share = 0.2, .seed = 5};
  auto const dropped = missing(with(fault), kDepth);
  EXPECT_NEAR(static_cast<double>(dropped.size()), 20, 12);  // 3 sigma
  EXPECT_EQ(missing(with(fault), kDepth), dropped);
  EXPECT_NE(missing(with(fault), kColor), dropped);
  fault.seed = 6;
  EXPECT_NE(missing(with(fault), kDepth), dropped);
  fault.share = 0;
  EXPECT_THAT(missing(with(fault), kDepth), ElementsAre());
  fault.share = 1;
  EXPECT_EQ(missing(with(fault), kDepth).size(), 100U);
}

TEST(SensorSchedule, ASlowStartCountsFromEachStart) {
  SensorScript script;
  script.start_delay_ns = kSecond_ns;
  SensorSchedule const schedule(script, 100);
  EXPECT_FALSE(schedule.at(kDepth, 29));
  EXPECT_TRUE(schedule.at(kDepth, 30));
  EXPECT_FALSE(schedule.at(kDepth, 89, 2 * kSecond_ns));
  EXPECT_TRUE(schedule.at(kDepth, 90, 2 * kSecond_ns));
}

TEST(SensorSchedule, ColorShiftMovesItsStampsAlone) {
  Fault const fault{.kind = FaultKind::kColorShift,
                    .from_ns = 0,
                    .until_ns = kSecond_ns,
                    .shift_ns = -20'000'000};
  SensorSchedule const schedule = with(fault);
  EXPECT_EQ(schedule.at(kColor, 0)->stamp_us, 980'000U);
  EXPECT_EQ(schedule.at(kDepth, 0)->stamp_us, 1'000'000U);
  EXPECT_EQ(schedule.at(kColor, 30)->stamp_us, 2'000'000U);
}

TEST(SensorSchedule, AClockJumpStays) {
  Fault const back{.kind = FaultKind::kClockJump, .from_ns = kSecond_ns, .shift_ns = -500'000'000};
  SensorSchedule const schedule = with(back);
  for (SensorStream const stream : {kDepth, kColor}) {
    EXPECT_EQ(schedule.at(stream, 29)->stamp_us, 1'966'666U);
    EXPECT_EQ(schedule.at(stream, 30)->stamp_us, 1'500'000U);
    EXPECT_EQ(schedule.at(stream, 90)->stamp_us, 3'500'000U);
  }
}

// 2^32 counts at 60 MHz are 71.582788 s.
TEST(SensorSchedule, AClockWrapsLikeAKinects) {
  SensorSchedule const schedule = with({.kind = FaultKind::kClockWrap, .from_ns = kSecond_ns});
  EXPECT_EQ(schedule.at(kDepth, 30)->stamp_us, 0U);
  EXPECT_EQ(schedule.at(kDepth, 31)->stamp_us, 33'333U);
  EXPECT_EQ(schedule.at(kDepth, 0)->stamp_us, 70'582'788U);
  EXPECT_EQ(schedule.at(kDepth, 30 + 2147)->stamp_us, 71'566'666U);
  EXPECT_EQ(schedule.at(kDepth, 30 + 2148)->stamp_us, 17'211U);
}

TEST(SensorSchedule, RegistrationIsIgnoredForATime) {
  Fault const fault{
      .kind = FaultKind::kIgnoredRegistration, .from_ns = kSecond_ns, .until_ns = 2 * kSecond_ns};
  SensorSchedule const schedule = with(fault);
  EXPECT_FALSE(schedule.at(kDepth, 29)->registration_ignored);
  EXPECT_TRUE(schedule.at(kDepth, 30)->registration_ignored);
  EXPECT_TRUE(schedule.at(kDepth, 59)->registration_ignored);
  EXPECT_FALSE(schedule.at(kDepth, 60)->registration_ignored);
}

TEST(SensorSchedule, ImagesAreCorruptForATime) {
  Fault const fault{.kind = FaultKind::kCorrupt,
                    .from_ns = kSecond_ns,
                    .until_ns = 2 * kSecond_ns,
                    .color = false,
                    .corruption = Corruption::kGarbage};
  SensorSchedule const schedule = with(fault);
  EXPECT_EQ(schedule.at(kDepth, 29)->corruption, Corruption::kNone);
  EXPECT_EQ(schedule.at(kDepth, 30)->corruption, Corruption::kGarbage);
  EXPECT_EQ(schedule.at(kColor, 30)->corruption, Corruption::kNone);
  EXPECT_EQ(schedule.at(kDepth, 60)->corruption, Corruption::kNone);
  EXPECT_NE(schedule.at(kDepth, 30)->seed, schedule.at(kDepth, 31)->seed);
}

TEST(SensorSchedule, KnowsHowOftenItWasUnplugged) {
  SensorScript script;
  script.faults = {
      {.kind = FaultKind::kUnplug, .from_ns = kSecond_ns, .until_ns = 2 * kSecond_ns},
      {.kind = FaultKind::kUnplug, .from_ns = 3 * kSecond_ns},
      {.kind = FaultKind::kStall, .from_ns = 0},
  };
  SensorSchedule const schedule(script, 100);
  EXPECT_EQ(schedule.plug_state(kSecond_ns - 1), (PlugState{true, 0}));
  EXPECT_EQ(schedule.plug_state(kSecond_ns), (PlugState{false, 1}));
  EXPECT_EQ(schedule.plug_state(2 * kSecond_ns - 1), (PlugState{false, 1}));
  EXPECT_EQ(schedule.plug_state(2 * kSecond_ns), (PlugState{true, 1}));
  EXPECT_EQ(schedule.plug_state(3 * kSecond_ns), (PlugState{false, 2}));
  EXPECT_EQ(schedule.plug_state(100 * kSecond_ns), (PlugState{false, 2}));
}

}  // namespace
}  // namespace credo::test
