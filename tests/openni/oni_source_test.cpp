#include "openni/oni_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <variant>

#include "core/error.hpp"
#include "support/oni_writer.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

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
  EXPECT_FALSE(frame->color_registered);
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
  capture.color_registered = ColorRegistered::kYes;
  FramePtr const frame = first(two_pixels(1), capture);
  EXPECT_EQ(frame->intrinsics, (CameraIntrinsics{7.0, 7.0, 0.25, 0.25}));
  EXPECT_TRUE(std::isnan(frame->cloud_camera.z[1])) << "too far";
  EXPECT_TRUE(frame->color_registered);
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

}  // namespace
}  // namespace credo::test
