// The whole way: a wall before a Kinect, through the fake bus, libfreenect, our driver and OpenNI2,
// to the frames of our own source.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <variant>

#include "core/error.hpp"
#include "drivers/freenect/rig.hpp"
#include "openni/openni_source.hpp"

namespace credo::test {
namespace {

using ::testing::HasSubstr;

constexpr int kWallRaw = 850;
/// The sensor's steps at that distance, half of one, in metres.
constexpr float kStep_m = 0.003F;

/// A flat wall, square before the camera, red.
fake_usb::Kinect before_a_wall() {
  fake_usb::Kinect one = kinect("A");
  one.images.depth_raw = {std::vector<std::uint16_t>(kPixels, kWallRaw)};
  std::vector<std::uint8_t> bayer;
  for (int p = 0; p < kPixels; ++p) {
    bool const red = p % 640 % 2 == 1 && p / 640 % 2 == 0;
    bayer.push_back(red ? 200 : 10);
  }
  one.images.color_bayer = {bayer};
  return one;
}

TEST(FreenectSource, FramesOfAWall) {
  fake_usb::plug(before_a_wall());
  OpenedSource const opened = open_openni("freenect://A", {}, {}, {}, {}, {});
  EXPECT_TRUE(opened.warnings.empty());
  auto const wall_m = static_cast<float>(fake_usb::depth_mm(kWallRaw) / 1000);
  std::int64_t last_ns = -1;
  int colored = 0;
  for (int i = 0; i < 15; ++i) {
    SourceResult const result = opened.source->next();
    ASSERT_TRUE(std::holds_alternative<FramePtr>(result)) << i;
    FramePtr const frame = std::get<FramePtr>(result);
    EXPECT_NEAR(frame->intrinsics.fx_px, 525.0, 0.01) << "depth is registered";
    EXPECT_GT(frame->stamp_ns, last_ns);
    last_ns = frame->stamp_ns;
    int measured = 0;
    for (float const z_m : frame->cloud_camera.z) {
      if (std::isfinite(z_m)) {
        ASSERT_NEAR(z_m, wall_m, kStep_m);
        ++measured;
      }
    }
    // The colour camera sees a little more than the depth camera; its pixels are a little larger.
    EXPECT_GT(measured, kPixels * 3 / 4);
    if (!frame->color.empty()) {
      ++colored;
      EXPECT_EQ(frame->color[320 * 640 + 320][0], 200);
      EXPECT_EQ(frame->color[320 * 640 + 320][2], 10);
    }
  }
  EXPECT_GT(colored, 0) << "colour may come after its depth";
  fake_usb::unplug("A");
}

TEST(FreenectSource, EndsWithAnErrorWhenUnplugged) {
  fake_usb::plug(before_a_wall());
  OpenedSource const opened = open_openni("", {}, {}, {}, {}, {});
  ASSERT_TRUE(std::holds_alternative<FramePtr>(opened.source->next()));
  fake_usb::unplug("A");
  try {
    for (int i = 0; i < 1000; ++i) {
      opened.source->next();
    }
    FAIL();
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(), HasSubstr("was unplugged"));
  }
}

TEST(FreenectSource, ABusyKinectIsSaid) {
  fake_usb::plug(before_a_wall());
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
