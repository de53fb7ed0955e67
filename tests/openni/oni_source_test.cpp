#include "openni/oni_source.hpp"

#include <OpenNI.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "openni/sensor_image.hpp"
#include "support/oni_writer.hpp"
#include "support/paths.hpp"
#include "support/recordings.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Two columns, one row; depth of 1 m and 2 m, left red and right blue.
OniScript two_pixels(int frames) {
  OniScript script;
  script.width = 2;
  script.height = 1;
  for (int i = 0; i < frames; ++i) {
    script.depth_images.push_back(packed({1000, 2000}));
    script.color_images.emplace_back("\xFF\0\0\0\0\xFF", 6);
  }
  return script;
}

class OniSource : public ::testing::Test {
protected:
  OpenedSource open(OniScript const& script, CaptureConfig const& capture = {},
                    PoseConfig const& pose = {}) {
    write_text(folder_ / "a.oni", oni_bytes(script));
    return open_oni(folder_ / "a.oni", capture, pose);
  }
  FramePtr first(OniScript const& script, CaptureConfig const& capture = {}) {
    return std::get<FramePtr>(open(script, capture).source->next());
  }

  TempFolder folder_;
};

TEST_F(OniSource, FramesInOrderWithTheirStamps) {
  OpenedSource const opened = open(two_pixels(3));
  EXPECT_EQ(opened.frame_count, 3U);
  EXPECT_TRUE(opened.warnings.empty());
  for (std::int64_t i = 0; i < 3; ++i) {
    auto const frame = std::get<FramePtr>(opened.source->next());
    EXPECT_EQ(number(frame->index), i);
    EXPECT_EQ(frame->stamp_ns, i * 33'333'000);
  }
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(opened.source->next()));
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(opened.source->next()));
}

TEST_F(OniSource, PointsByTheFieldOfView) {
  FramePtr const frame = first(two_pixels(1));
  double const fx_px = 1.0 / std::tan(0.5);  // half of two columns
  EXPECT_DOUBLE_EQ(frame->intrinsics.fx_px, fx_px);
  EXPECT_DOUBLE_EQ(frame->intrinsics.cx_px, 0.5);
  EXPECT_FLOAT_EQ(frame->cloud_camera.z[0], 1.0F);
  EXPECT_FLOAT_EQ(frame->cloud_camera.z[1], 2.0F);
  EXPECT_FLOAT_EQ(frame->cloud_camera.x[1], static_cast<float>(0.5 / fx_px * 2.0));
  EXPECT_EQ((frame->color[{0, 0}]), (Rgb{255, 0, 0}));
}

TEST_F(OniSource, MirroredIsTurnedBack) {
  OniScript script = two_pixels(1);
  script.mirrored = true;
  FramePtr const frame = first(script);
  EXPECT_FLOAT_EQ(frame->cloud_camera.z[0], 2.0F);
  EXPECT_FLOAT_EQ(frame->cloud_camera.z[1], 1.0F);
  EXPECT_EQ((frame->color[{0, 0}]), (Rgb{0, 0, 255}));
}

TEST_F(OniSource, TheConfigGoesFirst) {
  CaptureConfig capture;
  capture.camera_fx_px = capture.camera_fy_px = 7.0;
  capture.camera_cx_px = capture.camera_cy_px = 0.25;
  capture.max_depth_m = 1.5;
  FramePtr const frame = first(two_pixels(1), capture);
  EXPECT_EQ(frame->intrinsics, (CameraIntrinsics{7.0, 7.0, 0.25, 0.25}));
  EXPECT_TRUE(std::isnan(frame->cloud_camera.z[1])) << "too far";
  capture.camera_cy_px = 0;
  EXPECT_THROW(open(two_pixels(1), capture), InputError);
}

TEST_F(OniSource, AFieldOfViewThatIsNoneIsNotUsed) {
  OniScript script = two_pixels(1);
  script.fov_rad = std::nan("");
  EXPECT_DOUBLE_EQ(first(script)->intrinsics.fx_px, 525.0 * 2 / 640);
}

TEST_F(OniSource, ColourFarFromItsDepthIsNotItsColour) {
  OniScript script = two_pixels(2);
  script.color_delay_us = 15000;
  EXPECT_FALSE(first(script)->color.empty());
  script.color_delay_us = 20000;
  EXPECT_TRUE(first(script)->color.empty()) << "the next would be nearer, but nothing came before";
  script.color_images.clear();
  EXPECT_TRUE(first(script)->color.empty());
}

TEST_F(OniSource, WhatItCannotReadIsTold) {
  OniScript script = two_pixels(1);
  script.color_codec = "BZP2";
  EXPECT_THAT(open(script).warnings.at(0), HasSubstr("runs without colour, which is packed as"));
  script.depth_codec = "BZP2";
  try {
    open(script);
    FAIL();
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(), HasSubstr("depth is packed as BZP2, which is not read"));
  }
}

TEST_F(OniSource, PosesOfATrajectory) {
  write_text(folder_ / "poses.txt", "1 0 0 0.5 0 1 0 0 0 0 1 0\n");
  PoseConfig pose;
  pose.source = PoseSource::kFile;
  pose.file = (folder_ / "poses.txt").string();
  OpenedSource const opened = open(two_pixels(2), {}, pose);
  EXPECT_DOUBLE_EQ(std::get<FramePtr>(opened.source->next())->T_source_camera.translation().x(),
                   0.5);
  EXPECT_EQ(std::get<FrameFailure>(opened.source->next()).reason, "missing_pose");
}

/// What OpenNI2's own player makes of a recording: the slow twin, which loses what is damaged.
struct Played {
  std::vector<std::vector<std::uint16_t>> depth;
  std::vector<std::vector<Rgb>> color;
};

Played played_by_openni(fs::path const& path) {
  Played played;
  openni::OpenNI::initialize();
  {
    openni::Device device;
    EXPECT_EQ(device.open(path.c_str()), openni::STATUS_OK);
    device.getPlaybackControl()->setSpeed(-1);  // waits for whoever reads
    device.getPlaybackControl()->setRepeatEnabled(false);
    openni::VideoStream depth;
    openni::VideoStream color;
    depth.create(device, openni::SENSOR_DEPTH);
    color.create(device, openni::SENSOR_COLOR);
    depth.start();
    color.start();
    std::array<openni::VideoStream*, 2> streams = {&depth, &color};
    int ready = 0;
    while (openni::OpenNI::waitForAnyStream(streams.data(), 2, &ready, 1000) == openni::STATUS_OK) {
      openni::VideoFrameRef frame;
      streams.at(static_cast<std::size_t>(ready))->readFrame(&frame);
      auto const bytes = static_cast<std::size_t>(frame.getDataSize());
      if (ready == 0) {
        std::memcpy(played.depth.emplace_back(bytes / 2).data(), frame.getData(), bytes);
      } else {
        std::memcpy(played.color.emplace_back(bytes / 3).data(), frame.getData(), bytes);
      }
    }
  }
  openni::OpenNI::shutdown();
  return played;
}

// A real recording of a Kinect, mirrored, depth packed as 16zT and colour as JPEG.
TEST_F(OniSource, EqualsOpennisPlayerOnTheLivingRoom) {
  CREDO_REQUIRE_RECORDING("oni/living-room.oni");
  fs::path const path = recordings() / "oni/living-room.oni";
  Played const played = played_by_openni(path);
  OpenedSource const opened = open_oni(path, {}, {});
  EXPECT_EQ(opened.frame_count, 12U);
  ASSERT_EQ(played.depth.size(), 12U);
  ASSERT_EQ(played.color.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    auto const frame = std::get<FramePtr>(opened.source->next());
    ASSERT_EQ(frame->cloud_camera.width(), 640);
    Grid<float> depth_m = depth_image(played.depth[i], 640, 480, {});
    mirror(depth_m);
    Grid<Rgb> color(640, 480, played.color[i]);
    mirror(color);
    EXPECT_TRUE(frame->color == color) << i;
    int unlike = 0;
    for (std::size_t p = 0; p < depth_m.size(); ++p) {
      float const z = frame->cloud_camera.z[p];
      unlike += (depth_m[p] > 0 ? z != depth_m[p] : !std::isnan(z)) ? 1 : 0;
    }
    EXPECT_EQ(unlike, 0) << i;
  }
}

}  // namespace
}  // namespace credo::test
