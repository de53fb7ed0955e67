#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "io/dataset.hpp"
#include "support/recordings.hpp"

namespace credo {
namespace {

struct Recording {
  char const* name;
  int frames;
  CameraIntrinsics intrinsics;
};

std::string name_of(testing::TestParamInfo<Recording> const& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '-'; }, '_');
  return name;
}

class RecordingTest : public testing::TestWithParam<Recording> {};

// At most the first 15 frames, which are all of each but the kitchen.
TEST_P(RecordingTest, OpensAndDelivers) {
  Recording const& recording = GetParam();
  CREDO_REQUIRE_RECORDING(recording.name);
  OpenedSource const opened = open_dataset(test::recordings() / recording.name, {}, {});
  EXPECT_TRUE(opened.warnings.empty());
  EXPECT_EQ(opened.frame_count, static_cast<std::size_t>(recording.frames));
  int const count = std::min(recording.frames, 15);
  for (int i = 0; i < count; ++i) {
    SourceResult const result = opened.source->next();
    ASSERT_TRUE(std::holds_alternative<FramePtr>(result)) << "frame " << i;
    Frame const& frame = *std::get<FramePtr>(result);
    EXPECT_EQ(number(frame.index), i);
    EXPECT_EQ(frame.intrinsics, recording.intrinsics);
    EXPECT_EQ(frame.cloud_camera.width(), 640);
    EXPECT_EQ(frame.cloud_camera.height(), 480);
    EXPECT_TRUE(frame.color.same_size(frame.cloud_camera.z));
    EXPECT_TRUE(frame.T_source_camera.matrix().allFinite());
    std::size_t valid = 0;
    for (std::size_t p = 0; p < frame.cloud_camera.size(); ++p) {
      valid += frame.cloud_camera.valid(p) ? 1 : 0;
    }
    EXPECT_GT(valid, frame.cloud_camera.size() / 10);
  }
  if (count == recording.frames) {
    EXPECT_TRUE(std::holds_alternative<EndOfSource>(opened.source->next()));
  }
}

// The pixel and the point at it belong together: every point projects to its own pixel.
TEST_P(RecordingTest, PointsProjectToTheirPixels) {
  Recording const& recording = GetParam();
  CREDO_REQUIRE_RECORDING(recording.name);
  if (std::string(recording.name) == "osd") {
    GTEST_SKIP() << "its camera is not known to the pixel";
  }
  OpenedSource const opened = open_dataset(test::recordings() / recording.name, {}, {});
  FramePtr const held = std::get<FramePtr>(opened.source->next());
  Frame const& frame = *held;
  CameraIntrinsics const& k = frame.intrinsics;
  double worst_px = 0;
  for (std::size_t i = 0; i < frame.cloud_camera.size(); ++i) {
    if (frame.cloud_camera.valid(i)) {
      Eigen::Vector3d const p = frame.cloud_camera.at(i).cast<double>();
      Pixel const pixel = frame.color.pixel(i);
      worst_px = std::max({worst_px, std::abs(k.fx_px * p.x() / p.z() + k.cx_px - pixel.u),
                           std::abs(k.fy_px * p.y() / p.z() + k.cy_px - pixel.v)});
    }
  }
  EXPECT_LT(worst_px, 1.0);
}

constexpr CameraIntrinsics kXtion{567.8956, 568.8557, 312.1240, 242.5695};
constexpr CameraIntrinsics kPclKinect{525, 525, 320, 240};

INSTANTIATE_TEST_SUITE_P(
    All, RecordingTest,
    testing::Values(Recording{"kitchen", 500, {585, 585, 320, 240}},
                    Recording{"osd", 15, {525, 525, 319.5, 239.5}},
                    Recording{"thermos", 15, kXtion}, Recording{"appearing-boxes/cam1", 11, kXtion},
                    Recording{"appearing-boxes/cam2", 11, kXtion},
                    Recording{"frames/linemod-cat", 1, {572.4114, 573.57043, 325.2611, 242.04899}},
                    Recording{"frames/milk", 1, kPclKinect},
                    Recording{"frames/office", 1, kPclKinect},
                    Recording{"frames/grabber", 3, kPclKinect}),
    name_of);

}  // namespace
}  // namespace credo
