#include "io/dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "io/image.hpp"
#include "support/recordings.hpp"
#include "support/temp_folder.hpp"

namespace credo {
namespace {

using test::cut_file;
using test::TempFolder;
using test::write_text;
using testing::HasSubstr;

constexpr char kPose[] = "1 0 0 0.5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

std::string frame_name(int number, char const* kind) {
  char text[64];
  std::snprintf(text, sizeof text, "frame-%06d.%s", number, kind);
  return text;
}

/// Noise compresses badly, so that a cut file misses pixels.
Grid<std::uint16_t> some_depth(int width = 32, int height = 24) {
  Grid<std::uint16_t> depth(width, height);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    depth[i] = static_cast<std::uint16_t>(1000 + (i * 2654435761U >> 7U) % 1000);
  }
  return depth;
}

class DatasetTest : public testing::Test {
protected:
  void write_frame(int number, bool pose = true) {
    write_png16(folder_ / frame_name(number, "depth.png"), some_depth());
    Grid<Rgb> color(32, 24);
    for (std::size_t i = 0; i < color.size(); ++i) {
      color[i] = {static_cast<std::uint8_t>(i * 37), static_cast<std::uint8_t>(i * 101), 7};
    }
    write_png_rgb(folder_ / frame_name(number, "color.png"), color);
    if (pose) {
      write_text(folder_ / frame_name(number, "pose.txt"), kPose);
    }
  }
  void write_three() {
    for (int i = 0; i < 3; ++i) {
      write_frame(i);
    }
    write_text(folder_ / "camera-intrinsics.txt", "500 0 15.5 0 500 11.5 0 0 1");
  }
  [[nodiscard]] std::string open_error() const {
    try {
      open_dataset(folder_.path(), {}, {});
    } catch (InputError const& error) {
      return error.what();
    }
    return "no error";
  }
  /// The failure of frame 1; frames 0 and 2 must be good.
  FrameFailure second_frame() {
    OpenedSource opened = open_dataset(folder_.path(), {}, {});
    EXPECT_TRUE(std::holds_alternative<FramePtr>(opened.source->next()));
    SourceResult const second = opened.source->next();
    EXPECT_TRUE(std::holds_alternative<FramePtr>(opened.source->next()));
    EXPECT_TRUE(std::holds_alternative<EndOfSource>(opened.source->next()));
    auto const* failure = std::get_if<FrameFailure>(&second);
    return failure != nullptr ? *failure : FrameFailure{FrameIndex{-9}, "good", ""};
  }
  void expect_lost(std::string const& reason, std::string const& text) {
    FrameFailure const failure = second_frame();
    EXPECT_EQ(failure.reason, reason);
    EXPECT_EQ(number(failure.index), 1);
    EXPECT_THAT(failure.message, HasSubstr(text));
  }

  TempFolder folder_;
};

TEST_F(DatasetTest, ReadsWhatWasWritten) {
  write_three();
  OpenedSource opened = open_dataset(folder_.path(), {}, {});
  EXPECT_TRUE(opened.warnings.empty());
  EXPECT_EQ(opened.frame_count, 3U);
  auto const frame = std::get<FramePtr>(opened.source->next());
  EXPECT_EQ(frame->intrinsics, (CameraIntrinsics{500, 500, 15.5, 11.5}));
  EXPECT_EQ(frame->T_source_camera.translation().x(), 0.5);
  EXPECT_EQ(frame->stamp_ns, 0);
  EXPECT_FLOAT_EQ(frame->cloud_camera.z[5], static_cast<float>(some_depth()[5]) * 0.001F);
  EXPECT_EQ(frame->color[1][0], 37);
  EXPECT_EQ(std::get<FramePtr>(opened.source->next())->stamp_ns, 33333333);
}

TEST_F(DatasetTest, DepthZeroAndTheGreatestCountAreInvalid) {
  write_three();
  Grid<std::uint16_t> depth = some_depth();
  depth[0] = 0;
  depth[1] = 65535;
  depth[2] = 20000;  // beyond capture.max_depth_m
  write_png16(folder_ / frame_name(0, "depth.png"), depth);
  OpenedSource opened = open_dataset(folder_.path(), {}, {});
  auto const frame = std::get<FramePtr>(opened.source->next());
  EXPECT_FALSE(frame->cloud_camera.valid(0));
  EXPECT_FALSE(frame->cloud_camera.valid(1));
  EXPECT_FALSE(frame->cloud_camera.valid(2));
  EXPECT_TRUE(frame->cloud_camera.valid(3));
}

TEST_F(DatasetTest, WithoutIntrinsicsItWarnsOrTakesTheConfig) {
  write_frame(0);
  EXPECT_THAT(open_dataset(folder_.path(), {}, {}).warnings.at(0), HasSubstr("525 px"));
  CaptureConfig capture;
  capture.camera_fx_px = capture.camera_fy_px = 300;
  capture.camera_cx_px = capture.camera_cy_px = 12;
  OpenedSource opened = open_dataset(folder_.path(), capture, {});
  EXPECT_TRUE(opened.warnings.empty());
  EXPECT_EQ(std::get<FramePtr>(opened.source->next())->intrinsics.fx_px, 300);
}

TEST_F(DatasetTest, AFixedSensorNeedsNoPoses) {
  write_three();
  PoseConfig pose;
  pose.source = PoseSource::kFixed;
  OpenedSource opened = open_dataset(folder_.path(), {}, pose);
  EXPECT_EQ(std::get<FramePtr>(opened.source->next())->T_source_camera.translation().x(), 0.0);
}

TEST_F(DatasetTest, TakesPosesFromAFile) {
  write_three();
  write_text(folder_ / "path.txt",
             "# stamp x y z qx qy qz qw\n0 1 2 3 0 0 0 1\n0.1 2 2 3 0 0 0 1\n");
  PoseConfig pose;
  pose.source = PoseSource::kFile;
  pose.file = (folder_ / "path.txt").string();
  OpenedSource opened = open_dataset(folder_.path(), {}, pose);
  opened.source->next();
  EXPECT_NEAR(std::get<FramePtr>(opened.source->next())->T_source_camera.translation().x(),
              1.0 + 1.0 / 3.0, 1e-6);
}

TEST_F(DatasetTest, ReadsTheTumLayout) {
  write_png16(folder_ / "d.png", some_depth());
  write_png_rgb(folder_ / "c.png", Grid<Rgb>(32, 24));
  write_text(folder_ / "depth.txt", "# depth\n10.0 d.png\n10.1 d.png\n");
  write_text(folder_ / "rgb.txt", "10.01 c.png\n10.5 c.png\n");
  write_text(folder_ / "groundtruth.txt", "9.99 0 0 0 0 0 0 1\n10.01 1 0 0 0 0 0 1\n");
  OpenedSource opened = open_dataset(folder_.path(), {}, {});
  auto const frame = std::get<FramePtr>(opened.source->next());
  EXPECT_EQ(frame->stamp_ns, 10'000'000'000);
  EXPECT_NEAR(frame->T_source_camera.translation().x(), 0.5, 1e-9);
  EXPECT_FLOAT_EQ(frame->cloud_camera.z[0], static_cast<float>(some_depth()[0]) * 0.0002F);
  EXPECT_EQ(std::get<FrameFailure>(opened.source->next()).reason, "missing_color");
}

TEST_F(DatasetTest, ReadsTheNumberedLayout) {
  write_png16(folder_ / "0001.depth.png", some_depth());
  write_png_rgb(folder_ / "0001.color.png", Grid<Rgb>(32, 24));
  OpenedSource opened = open_dataset(folder_.path(), {}, {});
  EXPECT_EQ(number(std::get<FramePtr>(opened.source->next())->index), 0);
}

constexpr char kPcdHead[] =
    "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\n";

TEST_F(DatasetTest, ReadsOrganisedClouds) {
  write_text(folder_ / "a.pcd",
             std::string(kPcdHead) + "DATA ascii\n1 2 3\n0 0 0\nnan nan nan\n1 1 -1\n");
  OpenedSource opened = open_dataset(folder_.path(), {}, {});
  auto const frame = std::get<FramePtr>(opened.source->next());
  EXPECT_EQ(frame->cloud_camera.at(std::size_t{0}), Eigen::Vector3f(1, 2, 3));
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_FALSE(frame->cloud_camera.valid(i)) << i;
  }
}

TEST_F(DatasetTest, TurnsCloudsThatLieBehindTheCamera) {
  write_text(folder_ / "a.pcd",
             std::string(kPcdHead) + "DATA ascii\n1 2 -3\n1 1 -1\nnan nan nan\n1 1 1\n");
  OpenedSource opened = open_dataset(folder_.path(), {}, {});
  auto const frame = std::get<FramePtr>(opened.source->next());
  EXPECT_EQ(frame->cloud_camera.at(std::size_t{0}), Eigen::Vector3f(1, -2, 3));
}

// What is wrong from the start is said at open.

TEST_F(DatasetTest, NoFolder) {
  EXPECT_THROW(open_dataset(folder_ / "nowhere", {}, {}), InputError);
  try {
    open_dataset("/nowhere/at/all", {}, {});
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "dataset /nowhere/at/all: no such folder");
  }
}
TEST_F(DatasetTest, EmptyFolder) {
  EXPECT_THAT(open_error(), HasSubstr("no frames found; known"));
}
TEST_F(DatasetTest, BadIntrinsics) {
  write_three();
  write_text(folder_ / "camera-intrinsics.txt", "500 0 15.5 0 500");
  EXPECT_THAT(open_error(), HasSubstr("camera-intrinsics.txt: needs nine numbers"));
  write_text(folder_ / "camera-intrinsics.txt", "500 0 15 0 -500 11 0 0 1");
  EXPECT_THAT(open_error(), HasSubstr("not a pinhole camera matrix"));
}
TEST_F(DatasetTest, FirstFrameUnreadable) {
  write_three();
  write_text(folder_ / frame_name(0, "depth.png"), "");
  EXPECT_THAT(open_error(), HasSubstr("frame-000000.depth.png: empty file"));
}
TEST_F(DatasetTest, UnorganisedCloud) {
  write_text(folder_ / "a.pcd",
             "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
             "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n");
  EXPECT_THAT(open_error(), HasSubstr("not organised (2x1)"));
}
TEST_F(DatasetTest, CutCloud) {
  write_text(folder_ / "a.pcd", std::string(kPcdHead) + "DATA binary\n" + std::string(20, 'x'));
  EXPECT_THAT(open_error(), HasSubstr("cut short"));
}
TEST_F(DatasetTest, NotACloud) {
  write_text(folder_ / "a.pcd", "hello\n");
  EXPECT_THAT(open_error(), HasSubstr("a.pcd: "));
}

// What goes wrong later costs the frame.

TEST_F(DatasetTest, MissingColor) {
  write_three();
  std::filesystem::remove(folder_ / frame_name(1, "color.png"));
  expect_lost("missing_color", "frame-000001.depth.png: depth without colour");
}
TEST_F(DatasetTest, MissingDepth) {
  write_three();
  std::filesystem::remove(folder_ / frame_name(1, "depth.png"));
  expect_lost("missing_depth", "colour without depth");
}
TEST_F(DatasetTest, CutDepth) {
  write_three();
  cut_file(folder_ / frame_name(1, "depth.png"), 0.6);
  expect_lost("truncated_image", "frame-000001.depth.png: cut short");
}
TEST_F(DatasetTest, CutColor) {
  write_three();
  cut_file(folder_ / frame_name(1, "color.png"), 0.5);
  expect_lost("truncated_image", "frame-000001.color.png: cut short");
}
TEST_F(DatasetTest, NotAnImage) {
  write_three();
  write_text(folder_ / frame_name(1, "color.png"), "this is no image");
  expect_lost("unreadable_image", "neither PNG nor JPEG");
}
TEST_F(DatasetTest, DepthOfEightBits) {
  write_three();
  write_png_rgb(folder_ / frame_name(1, "depth.png"), Grid<Rgb>(32, 24));
  expect_lost("unreadable_image", "not a 16-bit grey PNG");
}
TEST_F(DatasetTest, WrongSize) {
  write_three();
  write_png16(folder_ / frame_name(1, "depth.png"), some_depth(16, 24));
  expect_lost("wrong_size", "is 16x24, the first frame is 32x24");
}
TEST_F(DatasetTest, ColorOfAnotherSize) {
  write_three();
  write_png_rgb(folder_ / frame_name(1, "color.png"), Grid<Rgb>(64, 48));
  expect_lost("wrong_size", "is 64x48, its depth 32x24");
}
TEST_F(DatasetTest, PoseWithFifteenNumbers) {
  write_three();
  write_text(folder_ / frame_name(1, "pose.txt"), "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0");
  expect_lost("bad_pose", "frame-000001.pose.txt: needs 16 numbers, has 15");
}
TEST_F(DatasetTest, PoseWithNan) {
  write_three();
  write_text(folder_ / frame_name(1, "pose.txt"), "1 0 0 nan 0 1 0 0 0 0 1 0 0 0 0 1");
  expect_lost("bad_pose", "not finite");
}
TEST_F(DatasetTest, PoseThatIsNoRotation) {
  write_three();
  write_text(folder_ / frame_name(1, "pose.txt"), "2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1");
  expect_lost("bad_pose", "not a rotation");
}
TEST_F(DatasetTest, MissingPose) {
  write_three();
  std::filesystem::remove(folder_ / frame_name(1, "pose.txt"));
  expect_lost("missing_pose", "no pose for frame 1");
}

TEST(Recordings, AllOpenAndDeliver) {
  struct Recording {
    char const* name;
    int frames;
  };
  for (Recording const& r :
       {Recording{"kitchen", 500}, Recording{"osd", 15}, Recording{"thermos", 15},
        Recording{"appearing-boxes/cam1", 11}, Recording{"appearing-boxes/cam2", 11},
        Recording{"frames/linemod-cat", 1}, Recording{"frames/milk", 1},
        Recording{"frames/office", 1}, Recording{"frames/grabber", 3}}) {
    CREDO_REQUIRE_RECORDING(r.name);
    OpenedSource opened = open_dataset(test::recordings() / r.name, {}, {});
    EXPECT_EQ(opened.frame_count, static_cast<std::size_t>(r.frames)) << r.name;
    for (int i = 0; i < std::min(r.frames, 15); ++i) {
      SourceResult const result = opened.source->next();
      ASSERT_TRUE(std::holds_alternative<FramePtr>(result)) << r.name << " " << i;
      Frame const& frame = *std::get<FramePtr>(result);
      EXPECT_EQ(frame.cloud_camera.width(), 640);
      EXPECT_EQ(frame.color.width(), 640);
      EXPECT_TRUE(frame.T_source_camera.matrix().allFinite());
    }
  }
}

}  // namespace
}  // namespace credo
