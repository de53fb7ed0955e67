// The whole way: a wall before a Kinect, through the fake bus, libfreenect, our driver and OpenNI2,
// to the frames of our own source.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stop_token>
#include <variant>

#include "core/error.hpp"
#include "drivers/freenect/rig.hpp"
#include "openni/openni_source.hpp"

namespace credo::test {
namespace {

using ::testing::HasSubstr;

/// The sensor's steps at these distances, half of one, in metres.
constexpr float kStep_m = 0.003F;

struct Wall {
  int raw;
  int red;
  int blue;
};
/// In turn: a farther one in red, a nearer one in blue.
constexpr std::array kWalls = {Wall{850, 200, 10}, Wall{800, 10, 200}};

/// Flat, square before the camera.
fake_usb::Kinect before_walls() {
  fake_usb::Kinect one = kinect("A");
  one.images = {};
  for (Wall const& wall : kWalls) {
    one.images.depth_raw.emplace_back(kPixels, static_cast<std::uint16_t>(wall.raw));
    std::vector<std::uint8_t> bayer;
    for (int p = 0; p < kPixels; ++p) {
      bool const odd_row = p / 640 % 2 == 1;
      bool const green = (p % 2 == 1) == odd_row;
      bayer.push_back(static_cast<std::uint8_t>(green ? 10 : odd_row ? wall.blue : wall.red));
    }
    one.images.color_bayer.push_back(bayer);
  }
  return one;
}

/// The wall of which all of it that was measured is; nullptr where there is none.
Wall const* wall_of(Frame const& frame) {
  auto const& z = frame.cloud_camera.z;
  auto const fits = [&](Wall const& wall) {
    auto const wall_m = static_cast<float>(fake_usb::depth_mm(wall.raw) / 1000);
    return std::ranges::all_of(
        z, [&](float z_m) { return !std::isfinite(z_m) || std::abs(z_m - wall_m) <= kStep_m; });
  };
  auto const found = std::ranges::find_if(kWalls, fits);
  return found == kWalls.end() ? nullptr : &*found;
}

// Slow, and colour before its depth: a busy machine has a quarter of a second for each frame.
TEST(FreenectSource, FramesOfWalls) {
  fake_usb::Kinect slow = before_walls();
  slow.rate_hz = 4;
  slow.color_lead = 0.5;
  fake_usb::plug(slow);
  OpenedSource const opened = open_openni("freenect://A", {}, {}, {}, {}, {});
  EXPECT_TRUE(opened.warnings.empty());
  std::int64_t last_ns = -1;
  constexpr int kFrames = 9;
  int colored = 0;
  for (int i = 0; i < kFrames; ++i) {
    SourceResult const result = opened.source->next();
    ASSERT_TRUE(std::holds_alternative<FramePtr>(result)) << i;
    FramePtr const frame = std::get<FramePtr>(result);
    EXPECT_NEAR(frame->intrinsics.fx_px, 525.0, 0.01) << "depth is registered";
    EXPECT_GT(frame->stamp_ns, last_ns);
    last_ns = frame->stamp_ns;
    // The colour camera sees a little more than the depth camera; its pixels are a little larger.
    EXPECT_GT(
        std::ranges::count_if(frame->cloud_camera.z, [](float z) { return std::isfinite(z); }),
        kPixels * 3 / 4);
    Wall const* const wall = wall_of(*frame);
    ASSERT_NE(wall, nullptr) << i;
    if (!frame->color.empty()) {
      ++colored;
      EXPECT_EQ(frame->color[320 * 640 + 320][0], wall->red) << "its own colour";
      EXPECT_EQ(frame->color[320 * 640 + 320][2], wall->blue);
    }
  }
  // The first one's may have begun before the start.
  EXPECT_GE(colored, kFrames - 2);
  fake_usb::unplug("A");
}

TEST(FreenectSource, AnUnpluggedKinectIsLookedForAndFound) {
  fake_usb::plug(before_walls());
  std::vector<std::string> notes;
  OpenedSource const opened =
      open_openni("", {}, {}, {}, [&](std::string const& note) { notes.push_back(note); }, {});
  std::int64_t before_ns = std::get<FramePtr>(opened.source->next())->stamp_ns;
  fake_usb::unplug("A");
  int unplugged = 0;
  bool back = false;
  for (int i = 0; i < 1000 && !back; ++i) {
    SourceResult const result = opened.source->next();
    if (auto const* frame = std::get_if<FramePtr>(&result)) {
      EXPECT_GT((*frame)->stamp_ns, before_ns);
      before_ns = (*frame)->stamp_ns;
      back = unplugged > 0;
    } else if (std::get<FrameFailure>(result).reason == "unplugged") {
      ++unplugged;
      fake_usb::plug(before_walls());
    }
  }
  EXPECT_TRUE(back);
  EXPECT_EQ(unplugged, 1);
  EXPECT_THAT(notes, testing::Contains(HasSubstr("is back after")));
  fake_usb::unplug("A");
}

TEST(FreenectSource, ABusyKinectIsSaid) {
  fake_usb::plug(before_walls());
  fake_usb::set_faults("A", {.claim_error = -6});
  try {
    open_openni("freenect://A", {}, {}, {}, {}, {});
    FAIL();
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(), HasSubstr("LIBUSB_ERROR_BUSY"));
  }
  fake_usb::unplug("A");
}

}  // namespace
}  // namespace credo::test
