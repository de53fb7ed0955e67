#include "io/dataset.hpp"

#include <cmath>

#include "io/dataset_fixture.hpp"

namespace credo {
namespace {

using test::DatasetTest;
using test::next_frame;
using test::some_color;
using test::some_depth;
using test::write_text;
using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(DatasetTest, ReadsFramesWithPoses) {
  write_three();
  OpenedSource const opened = open();
  EXPECT_THAT(opened.warnings, IsEmpty());
  EXPECT_EQ(opened.frame_count, 3U);
  FramePtr const first = next_frame(opened);
  EXPECT_EQ(number(first->index), 0);
  EXPECT_EQ(first->stamp_ns, 0);
  EXPECT_EQ(first->intrinsics, (CameraIntrinsics{500, 500, 15.5, 11.5}));
  EXPECT_EQ(first->T_source_camera.translation().x(), 0.5);
  EXPECT_EQ(first->color, some_color());
  for (std::size_t i = 0; i < some_depth().size(); ++i) {
    ASSERT_FLOAT_EQ(first->cloud_camera.z[i], static_cast<float>(some_depth()[i]) * 0.001F);
  }
  FramePtr const second = next_frame(opened);
  EXPECT_EQ(number(second->index), 1);
  EXPECT_EQ(second->stamp_ns, 33'333'333);
  EXPECT_EQ(next_frame(opened)->stamp_ns, 66'666'666);
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(opened.source->next()));
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(opened.source->next())) << "and from then on";
}

TEST_F(DatasetTest, APixelBecomesThePointItSees) {
  write_three();
  FramePtr const frame = next_frame(open());
  Pixel const pixel{20, 3};
  auto const z = static_cast<float>(some_depth()[pixel]) * 0.001F;
  Eigen::Vector3f const expected(z * (20 - 15.5F) / 500, z * (3 - 11.5F) / 500, z);
  EXPECT_TRUE(frame->cloud_camera.at(pixel).isApprox(expected, 1e-6F));
}

TEST_F(DatasetTest, DepthZeroTheGreatestCountAndFarDepthAreInvalid) {
  write_three();
  Grid<std::uint16_t> depth = some_depth();
  depth[0] = 0;
  depth[1] = 65535;
  depth[2] = 2001;
  depth[3] = 2000;
  write_png16(file(0, "depth.png"), depth);
  CaptureConfig capture;
  capture.max_depth_m = 2.0;
  FramePtr const frame = next_frame(open(capture));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(frame->cloud_camera.at(i).array().isNaN().all()) << i;
  }
  EXPECT_TRUE(frame->cloud_camera.valid(3));
}

TEST_F(DatasetTest, TheConfigMaySayTheDepthUnit) {
  write_three();
  CaptureConfig capture;
  capture.depth_unit_m = 0.002;
  EXPECT_FLOAT_EQ(next_frame(open(capture))->cloud_camera.z[5],
                  static_cast<float>(some_depth()[5]) * 0.002F);
}

TEST_F(DatasetTest, TheConfigMaySayThatColourIsRegistered) {
  write_three();
  EXPECT_FALSE(next_frame(open())->color_registered);
  CaptureConfig capture;
  capture.color_registered = ColorRegistered::kYes;
  EXPECT_TRUE(next_frame(open(capture))->color_registered);
}

TEST_F(DatasetTest, TheConfigMaySayThatColourIsNotRegistered) {
  write_tum_images();
  write_text(folder_ / "depth.txt", "10.0 d0.png\n");
  write_text(folder_ / "rgb.txt", "10.0 c0.png\n");
  EXPECT_TRUE(next_frame(open())->color_registered);
  CaptureConfig capture;
  capture.color_registered = ColorRegistered::kNo;
  EXPECT_FALSE(next_frame(open(capture))->color_registered);
}

TEST_F(DatasetTest, WithoutIntrinsicsItWarnsOnce) {
  write_frame(0);
  write_frame(1);
  OpenedSource const opened = open();
  EXPECT_EQ(opened.warnings.size(), 1U);
  EXPECT_EQ(next_frame(opened)->intrinsics, (CameraIntrinsics{525, 525, 15.5, 11.5}));
}

TEST_F(DatasetTest, ARecordingWithoutAnyPoseStandsStill) {
  write_three();
  for (int i = 0; i < 3; ++i) {
    std::filesystem::remove(file(i, "pose.txt"));
  }
  OpenedSource const opened = open();
  next_frame(opened);
  EXPECT_TRUE(next_frame(opened)->T_source_camera.matrix().isIdentity(0.0));
}

TEST_F(DatasetTest, AFixedSensorNeedsNoPoses) {
  write_three();
  write_text(file(1, "pose.txt"), "no pose at all");
  PoseConfig pose;
  pose.source = PoseSource::kFixed;
  OpenedSource const opened = open({}, pose);
  EXPECT_TRUE(next_frame(opened)->T_source_camera.matrix().isIdentity(0.0));
  EXPECT_TRUE(next_frame(opened)->T_source_camera.matrix().isIdentity(0.0));
}

TEST_F(DatasetTest, TakesPosesFromAFileByStamp) {
  write_three();
  write_text(folder_ / "path.txt", "0 1 2 3 0 0 0 1\n0.1 2 2 3 0 0 0 1\n");
  PoseConfig pose;
  pose.source = PoseSource::kFile;
  pose.file = (folder_ / "path.txt").string();
  OpenedSource const opened = open({}, pose);
  EXPECT_EQ(next_frame(opened)->T_source_camera.translation().x(), 1.0);
  EXPECT_NEAR(next_frame(opened)->T_source_camera.translation().x(), 1.0 + 1.0 / 3.0, 1e-6);
}

TEST_F(DatasetTest, TakesPosesFromAFileByFrame) {
  write_three();
  write_text(folder_ / "path.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n1 0 0 8 0 1 0 0 0 0 1 0\n");
  PoseConfig pose;
  pose.source = PoseSource::kFile;
  pose.file = (folder_ / "path.txt").string();
  OpenedSource const opened = open({}, pose);
  EXPECT_EQ(next_frame(opened)->T_source_camera.translation().x(), 7.0);
  EXPECT_EQ(next_frame(opened)->T_source_camera.translation().x(), 8.0);
  EXPECT_EQ(std::get<FrameFailure>(opened.source->next()).reason, "missing_pose");
}

TEST_F(DatasetTest, NumbersMayStartAnywhereAndHaveGaps) {
  write_frame(7);
  write_frame(1000001);
  write_frame(8);
  // A pose alone is no frame.
  write_text(file(9, "pose.txt"), "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  OpenedSource const opened = open();
  EXPECT_EQ(opened.frame_count, 3U);
  for (int i = 0; i < 3; ++i) {
    FramePtr const frame = next_frame(opened);
    EXPECT_EQ(number(frame->index), i);
    EXPECT_EQ(frame->stamp_ns, std::int64_t{1'000'000'000} * i / 30);
  }
}

TEST_F(DatasetTest, ReadsTheNumberedLayout) {
  write_png16(folder_ / "0001.depth.png", some_depth());
  write_png_rgb(folder_ / "0001.color.png", some_color());
  OpenedSource const opened = open();
  EXPECT_EQ(opened.frame_count, 1U);
  FramePtr const frame = next_frame(opened);
  EXPECT_EQ(number(frame->index), 0);
  EXPECT_EQ(frame->color, some_color());
  EXPECT_FALSE(frame->color_registered);
  EXPECT_FLOAT_EQ(frame->cloud_camera.z[0], static_cast<float>(some_depth()[0]) * 0.001F);
}

TEST_F(DatasetTest, ReadsTheTumLayout) {
  write_tum_images();
  write_text(folder_ / "depth.txt", "# depth maps\n10.0 d0.png\n10.1 d1.png\n");
  write_text(folder_ / "rgb.txt", "# colour\n9.985 c0.png\n10.01 c1.png\n10.081 c0.png\n");
  write_text(folder_ / "groundtruth.txt",
             "# stamp tx ty tz qx qy qz qw\n9.99 0 0 0 0 0 0 1\n10.01 1 0 0 0 0 0 1\n"
             "10.09 1 0 0 0 0 0 1\n10.11 5 0 0 0 0 0 1\n");
  OpenedSource const opened = open();
  EXPECT_EQ(opened.frame_count, 2U);
  FramePtr const first = next_frame(opened);
  EXPECT_EQ(first->stamp_ns, 10'000'000'000);
  EXPECT_NEAR(first->T_source_camera.translation().x(), 0.5, 1e-6);
  EXPECT_FLOAT_EQ(first->cloud_camera.z[0], static_cast<float>(some_depth()[0]) * 0.0002F);
  EXPECT_EQ(first->color[0], (Rgb{1, 1, 1})) << "10 ms away, the other 15";
  FramePtr const second = next_frame(opened);
  EXPECT_EQ(second->stamp_ns, 10'100'000'000);
  EXPECT_NEAR(second->T_source_camera.translation().x(), 3.0, 1e-6);
  EXPECT_EQ(second->color[0], (Rgb{0, 0, 0}));
  EXPECT_TRUE(second->color_registered);
}

TEST_F(DatasetTest, ATumFrameWithoutColourOrPoseInTimeIsLost) {
  write_tum_images();
  write_text(folder_ / "depth.txt", "10.0 d0.png\n10.1 d1.png\n10.2 d1.png\n10.3 d9.png\n");
  write_text(folder_ / "rgb.txt", "10.0 c0.png\n10.121 c1.png\n10.2 c1.png\n10.3 c1.png\n");
  write_text(folder_ / "groundtruth.txt", "10.0 0 0 0 0 0 0 1\n10.1 0 0 0 0 0 0 1\n");
  OpenedSource const opened = open();
  next_frame(opened);
  EXPECT_EQ(std::get<FrameFailure>(opened.source->next()).reason, "missing_color");
  EXPECT_EQ(std::get<FrameFailure>(opened.source->next()).reason, "missing_pose");
  EXPECT_EQ(std::get<FrameFailure>(opened.source->next()).reason, "missing_depth");
}

TEST_F(DatasetTest, TumDepthFromBeforeTheOtherStreamsIsNoFrame) {
  write_tum_images();
  write_text(folder_ / "depth.txt", "9.8 d0.png\n9.9 d0.png\n10.0 d1.png\n");
  write_text(folder_ / "rgb.txt", "9.9 c0.png\n10.0 c0.png\n");
  write_text(folder_ / "groundtruth.txt", "10.0 4 0 0 0 0 0 1\n");
  write_text(folder_ / "camera-intrinsics.txt", "500 0 15.5 0 500 11.5 0 0 1");
  OpenedSource const opened = open();
  EXPECT_EQ(opened.frame_count, 1U);
  EXPECT_THAT(opened.warnings,
              ElementsAre(folder_.path().string() + ": passing over the first 2 depth images, "
                                                    "which have no colour or no pose"));
  FramePtr const frame = next_frame(opened);
  EXPECT_EQ(number(frame->index), 0);
  EXPECT_EQ(frame->T_source_camera.translation().x(), 4.0);
}

TEST_F(DatasetTest, ReadsCloudsInOrderOfTheirNames) {
  for (std::string const name : {"b", "a"}) {
    std::string const z = name == "a" ? "1" : "2";
    write_text(folder_ / (name + ".pcd"),
               "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\n"
               "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA ascii\n0 0 " +
                   z + "\n0 0 1\n0 0 1\n0 0 1\n");
  }
  OpenedSource const opened = open();
  EXPECT_EQ(next_frame(opened)->cloud_camera.z[0], 1.0F);
  FramePtr const second = next_frame(opened);
  EXPECT_EQ(second->cloud_camera.z[0], 2.0F);
  EXPECT_TRUE(second->color_registered);
  EXPECT_EQ(number(second->index), 1);
  EXPECT_EQ(second->stamp_ns, 33'333'333);
  EXPECT_TRUE(second->T_source_camera.matrix().isIdentity(0.0));
}

}  // namespace
}  // namespace credo
