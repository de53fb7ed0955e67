// Our own live source on a virtual sensor: whatever that does, the run goes on, loses what the
// fault ate and no more, and counts it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "drivers/virtual/virtual_source.hpp"
#include "openni/sensor_list.hpp"

namespace credo::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;

TEST_F(VirtualSource, SeesWhatTheDatasetHolds) {
  open("");
  Seen const seen = read_until(0.7);
  for (FramePtr const& frame : seen.frames) {
    // The image is known by its first pixel.
    auto const image =
        static_cast<std::size_t>(std::lround((1000 * frame->cloud_camera.z[0] - 300) / 60));
    Grid<std::uint16_t> const expected = depth_of(image);
    for (std::size_t p = 1; p < expected.size(); ++p) {
      float const z_m = frame->cloud_camera.z[p];
      ASSERT_EQ(std::isnan(z_m) ? 0 : std::lround(1000 * z_m), expected[p]) << p;
    }
    EXPECT_TRUE(frame->color.empty() || frame->color == color_of(image));
    EXPECT_TRUE(frame->color_registered);
    EXPECT_NEAR(frame->intrinsics.fx_px, kFocal_px, 1e-4);
    // After 2020, by this computer's clock.
    EXPECT_GT(frame->arrival_ns, 1'577'836'800'000'000'000);
  }
  EXPECT_GT(seen.colored(), 0);
  EXPECT_EQ(seen.lost_by("stalled"), 0);
  EXPECT_THAT(notes_, IsEmpty());
  expect_all_counted(seen);
}

TEST_F(VirtualSource, AStallIsTold) {
  open(R"({"fault": "stall", "at_frame": 10, "for_s": 3})");
  Seen const seen = read_until(4);
  EXPECT_EQ(seen.lost_by("stalled"), 1);
  EXPECT_GE(seen.lost_by("missed"), 90);
  expect_all_counted(seen);
}

TEST_F(VirtualSource, ASensorThatStaysSilentIsOpenedAnew) {
  SensorConfig config;
  config.stall_s = 0.3;
  open(R"({"fault": "stall", "at_frame": 10, "for_s": 2})", config);
  Seen const seen = read_until(3);
  EXPECT_GE(seen.lost_by("stalled"), 3);
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("is back after")));
}

TEST_F(VirtualSource, WithoutColourDepthGoesOn) {
  SensorConfig config;
  config.stall_s = 0.5;
  open(R"({"fault": "stall", "stream": "color", "at_frame": 10, "for_s": 1.5})", config);
  read_until(0.9);
  Seen const without = read_until(1.7);
  EXPECT_GT(without.frames.size(), 5U);
  EXPECT_EQ(without.colored(), 0);
  Seen const with = read_until(3.5);
  EXPECT_GT(with.colored(), 0);
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("sends no colour; starting it anew")));
}

TEST_F(VirtualSource, AnUnpluggedSensorIsLookedForAndFound) {
  SensorConfig config;
  config.stall_s = 1;
  // Plugged in again, its clock is another's: that is no jump.
  open(R"({"fault": "unplug", "at_frame": 10, "for_s": 2.5},
          {"fault": "clock_jump", "by_s": 20, "at_s": 1.5})",
       config);
  Seen const seen = read_until(4);
  EXPECT_EQ(seen.lost_by("unplugged"), 1);
  EXPECT_THAT(seen.lost_by("away"), AllOf(Ge(1), Le(4)));
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("is back after")));
}

TEST_F(VirtualSource, TimeGoesOnWhenTheClockJumps) {
  for (char const* by_s : {"-0.5", "20"}) {
    opened_ = {};
    notes_.clear();
    next_index_ = 0;
    open(std::string(R"({"fault": "clock_jump", "at_frame": 15, "by_s": )") + by_s + "}");
    Seen const seen = read_until(1.5);
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("its clock jumped"))) << by_s;
    for (std::size_t i = 1; i < seen.frames.size(); ++i) {
      // By the host's clock, as images come on a loaded machine.
      EXPECT_LT(seen.frames[i]->stamp_ns - seen.frames[i - 1]->stamp_ns, 700'000'000) << by_s;
    }
  }
}

TEST_F(VirtualSource, AWrapOfTheClockIsNotSeen) {
  open(R"({"fault": "clock_wrap", "at_frame": 15})");
  std::int64_t first_ns = 0;
  Seen seen;
  for (int i = 0; i < 40; ++i) {
    SourceResult const result = opened_.source->next();
    if (auto const* frame = std::get_if<FramePtr>(&result)) {
      first_ns = first_ns == 0 ? (*frame)->stamp_ns : first_ns;
      double const ticks = static_cast<double>((*frame)->stamp_ns - first_ns) * 30e-9;
      // Stamps are whole microseconds.
      EXPECT_NEAR(ticks, std::round(ticks), 1e-4);
      EXPECT_LT(ticks, 60);
    }
  }
  EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(VirtualSource, BrokenImagesAreCountedAndNotTaken) {
  for (char const* how : {"size", "short"}) {
    opened_ = {};
    next_index_ = 0;
    open(
        std::string(R"({"fault": "corrupt", "stream": "depth", "at_frame": 10, "for_frames": 7,)") +
        R"("how": ")" + how + "\"}");
    Seen const seen = read_until(1);
    EXPECT_THAT(seen.lost_by("broken_image"), AllOf(Ge(1), Le(7))) << how;
    for (FramePtr const& frame : seen.frames) {
      EXPECT_TRUE(tick_of(*frame) < 10 || tick_of(*frame) >= 17) << how;
    }
    expect_all_counted(seen);
  }
}

TEST_F(VirtualSource, ImagesThatDoNotComeAreCounted) {
  for (char const* fault : {R"({"fault": "rate", "every": 2, "at_frame": 5, "for_frames": 20})",
                            R"({"fault": "drop", "share": 0.4, "seed": 1})"}) {
    opened_ = {};
    next_index_ = 0;
    open(fault);
    Seen const seen = read_until(1);
    EXPECT_GE(seen.lost_by("missed"), 6) << fault;
    expect_all_counted(seen);
  }
}

TEST_F(VirtualSource, AFirstImageThatIsLateIsNoFault) {
  open(R"({"fault": "slow_start", "delay_s": 3})");
  EXPECT_THAT(read_until(3.2).lost, testing::Not(testing::Contains(testing::Key("stalled"))));
}

TEST_F(VirtualSource, ColourOfAnotherMomentIsPairedAsFarAsItIsNear) {
  open(R"({"fault": "color_shift", "by_ms": 12})");
  EXPECT_GT(read_until(1).colored(), 0);
}

TEST_F(VirtualSource, IsListed) {
  open("");
  std::vector<SensorInfo> const sensors = list_sensors();
  ASSERT_EQ(sensors.size(), 1U);
  EXPECT_EQ(sensors[0].uri, "virtual://a");
  EXPECT_EQ(sensors[0].trouble, "");
  EXPECT_TRUE(sensors[0].registers);
  ASSERT_FALSE(sensors[0].depth_modes.empty());
  EXPECT_EQ(sensors[0].depth_modes[0].width_px, kWidth);
  EXPECT_EQ(sensors[0].depth_modes[0].rate_hz, 30);
  EXPECT_EQ(sensors[0].depth_modes[0].format, "1 mm");
  ASSERT_FALSE(sensors[0].color_modes.empty());
  EXPECT_EQ(sensors[0].color_modes[0].format, "RGB888");
}

TEST_F(VirtualSource, ASensorThatIsNotThereIsAnError) {
  ::setenv("CREDO_VIRTUAL_SENSOR", "", 1);
  try {
    static_cast<void>(open_openni("virtual://b", {}, {}, {}, {}, {}));
    FAIL();
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("openni:virtual://b: no such sensor"), HasSubstr("credo devices")));
  }
}

}  // namespace
}  // namespace credo::test
