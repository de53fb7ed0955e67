#include "stages/clustering/clustering.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace credo {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A wall of pixels 1 cm apart in both directions, at the depth of each column, facing the camera.
Frame frame_of(int width, int height, std::vector<float> const& column_depths_m) {
  Frame frame;
  frame.cloud_camera = OrganizedCloud(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      frame.cloud_camera.set(frame.cloud_camera.x.index({u, v}),
                             {0.01F * static_cast<float>(u), 0.01F * static_cast<float>(v),
                              column_depths_m[static_cast<std::size_t>(u)]});
    }
  }
  return frame;
}

NormalMap facing_normals(Frame const& frame) {
  NormalMap normals(frame.cloud_camera.width(), frame.cloud_camera.height());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    normals.set(i, -Eigen::Vector3f::UnitZ());
  }
  return normals;
}

// Two boards, 10 columns each, the second 20 cm behind the first.
Frame two_boards() {
  std::vector<float> depths_m(20, 1.0F);
  std::fill(depths_m.begin() + 10, depths_m.end(), 1.2F);
  return frame_of(20, 10, depths_m);
}

Segmentation cluster(Frame const& frame, NormalMap const& normals,
                     ClusteringConfig const& config = {.min_pixels = 25}) {
  return cluster_stuff(frame, normals, unassigned_segmentation(frame, Se3(), kPriorFrame), config);
}

TEST(ClusterStuff, SeparatesAtADepthJump) {
  Frame const frame = two_boards();
  Segmentation const result = cluster(frame, facing_normals(frame));
  ASSERT_THAT(result.stuff, SizeIs(2));
  for (int v = 0; v < 10; ++v) {
    for (int u = 0; u < 20; ++u) {
      EXPECT_EQ((result.labels[{u, v}]), u < 10 ? kFirstStuff : kFirstStuff + 1);
    }
  }
  StuffCluster const& front = result.stuff[0];
  EXPECT_EQ(front.label, kFirstStuff);
  EXPECT_EQ(front.pixel_count, 100U);
  EXPECT_TRUE(front.bounds_world.min().isApprox(Eigen::Vector3f(0.0F, 0.0F, 1.0F)));
  EXPECT_TRUE(front.bounds_world.max().isApprox(Eigen::Vector3f(0.09F, 0.09F, 1.0F)));
  EXPECT_TRUE(front.centroid_world.isApprox(Eigen::Vector3f(0.045F, 0.045F, 1.0F), 1e-5F));
  EXPECT_FALSE(front.points_world.empty());
  EXPECT_LT(front.points_world.size(), front.pixel_count);
}

TEST(ClusterStuff, SeparatesAtACrease) {
  Frame const frame = frame_of(20, 10, std::vector<float>(20, 1.0F));
  NormalMap normals = facing_normals(frame);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (i % 20 >= 10) {
      normals.set(i, {std::sin(0.31F), 0.0F, -std::cos(0.31F)});
    }
  }
  EXPECT_THAT(cluster(frame, normals).stuff, SizeIs(2));
  EXPECT_THAT(cluster(frame, normals, {.max_angle_rad = 0.32}).stuff, SizeIs(1));
}

TEST(ClusterStuff, GivesWorldCoordinates) {
  Frame const frame = two_boards();
  // The camera looks along the world's x, one metre up: right is -y, down is -z.
  Eigen::Matrix4d matrix;
  matrix << 0, 0, 1, 5, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 1;
  Segmentation const result = cluster_stuff(
      frame, facing_normals(frame),
      unassigned_segmentation(frame, Se3::from_matrix(matrix), kPriorFrame), {.min_pixels = 25});
  ASSERT_THAT(result.stuff, SizeIs(2));
  EXPECT_TRUE(
      result.stuff[1].centroid_world.isApprox(Eigen::Vector3f(6.2F, -0.145F, 0.955F), 1e-5F));
  EXPECT_TRUE(result.stuff[1].bounds_world.isApprox(Eigen::AlignedBox3f(
      Eigen::Vector3f(6.2F, -0.19F, 0.91F), Eigen::Vector3f(6.2F, -0.1F, 1.0F))));
  for (Eigen::Vector3f const& point : result.stuff[1].points_world) {
    EXPECT_NEAR(point.x(), 6.2F, 1e-5F);
  }
}

TEST(ClusterStuff, LeavesWhatIsExplained) {
  Frame const frame = two_boards();
  Segmentation before = unassigned_segmentation(frame, Se3(), kPriorFrame);
  std::fill(before.labels.begin(), before.labels.begin() + 100, kFloor);
  Segmentation const result =
      cluster_stuff(frame, facing_normals(frame), before, {.min_pixels = 25});
  EXPECT_THAT(result.labels.row(4), Each(kFloor));
  ASSERT_THAT(result.stuff, SizeIs(2));
  EXPECT_EQ(result.stuff[0].pixel_count, 50U);
}

/// Two columns of segments over a board that is one cluster without: 5 left of column 10, 2 right
/// of it, and none in the last row.
Segmentation with_segments(Frame const& frame) {
  Segmentation before = unassigned_segmentation(frame, Se3(), kPriorFrame);
  Grid<std::int32_t>& segments = before.segments.labels;
  segments = Grid<std::int32_t>(20, 10, 2);
  for (int v = 0; v < 10; ++v) {
    std::ranges::fill(segments.row(v).first(10), 5);
  }
  std::ranges::fill(segments.row(9), 0);
  before.segments.pixel_counts = {0, 90, 0, 0, 90};
  return before;
}

TEST(ClusterStuff, IsOneForEachSegment) {
  Frame const frame = frame_of(20, 10, std::vector<float>(20, 1.0F));
  NormalMap const normals = facing_normals(frame);
  ASSERT_THAT(cluster(frame, normals).stuff, SizeIs(1));
  // Normals have no part in it.
  Segmentation const result =
      cluster_stuff(frame, NormalMap(20, 10), with_segments(frame), {.min_pixels = 1});
  ASSERT_THAT(result.stuff, SizeIs(2));
  EXPECT_EQ(result.stuff[0].pixel_count, 90U);
  EXPECT_EQ(result.stuff[1].pixel_count, 90U);
  EXPECT_EQ((result.labels[{9, 0}]), kFirstStuff) << "by first pixels, whatever their numbers";
  EXPECT_EQ((result.labels[{10, 0}]), kFirstStuff + 1);
  EXPECT_THAT(result.labels.row(9), Each(kUnassigned)) << "no segment";
}

TEST(ClusterStuff, WhatIsLeftOfASegmentStaysOneThing) {
  Frame const frame = frame_of(20, 10, std::vector<float>(20, 1.0F));
  Segmentation before = with_segments(frame);
  for (int v = 0; v < 10; ++v) {
    std::ranges::fill(before.labels.row(v).subspan(3, 4), kFloor);
  }
  Segmentation const result = cluster_stuff(frame, NormalMap(20, 10), before, {.min_pixels = 1});
  ASSERT_THAT(result.stuff, SizeIs(2));
  EXPECT_EQ(result.stuff[0].pixel_count, 54U);
  EXPECT_EQ((result.labels[{0, 0}]), (result.labels[{8, 0}]));
  EXPECT_THAT(cluster_stuff(frame, NormalMap(20, 10), before, {.min_pixels = 55}).stuff, SizeIs(1));
}

TEST(ClusterStuff, SpecksThatAreLeftOfASegmentAreNone) {
  Frame const frame = frame_of(20, 10, std::vector<float>(20, 1.0F));
  Segmentation before = with_segments(frame);
  // 54 pixels in two pieces are left of the first segment; a third lies on the second.
  for (int v = 0; v < 10; ++v) {
    std::ranges::fill(before.labels.row(v).subspan(3, 4), kFloor);
  }
  for (int v = 2; v < 8; ++v) {
    std::ranges::fill(before.segments.labels.row(v).last(6), 3);
  }
  before.segments.lies_on = {0, 0, 2, 0, 0};
  EXPECT_THAT(cluster_stuff(frame, NormalMap(20, 10), before, {.min_pixels = 27}).stuff, SizeIs(3));
  Segmentation const result = cluster_stuff(frame, NormalMap(20, 10), before, {.min_pixels = 28});
  ASSERT_THAT(result.stuff, SizeIs(2));
  EXPECT_EQ(result.stuff[0].label, kFirstStuff);
  EXPECT_EQ(result.stuff[0].pixel_count, 54U);
  EXPECT_FALSE(result.stuff[0].lies_on.has_value());
  EXPECT_EQ(result.stuff[1].pixel_count, 36U);
  EXPECT_EQ(result.stuff[1].lies_on, std::optional(kFirstStuff));
  EXPECT_THAT(result.labels.row(4).first(3), Each(kUnassigned));
  EXPECT_THAT(result.labels.row(4).subspan(3, 4), Each(kFloor));
  EXPECT_THAT(result.labels.row(4).subspan(7, 3), Each(kUnassigned));
  EXPECT_THAT(result.labels.row(4).subspan(10, 4), Each(kFirstStuff));
  EXPECT_THAT(result.labels.row(4).last(6), Each(kFirstStuff + 1));
}

TEST(ClusterStuff, IgnoresSmallClusters) {
  Frame const frame = two_boards();
  NormalMap const normals = facing_normals(frame);
  EXPECT_THAT(cluster(frame, normals, {.min_pixels = 100}).stuff, SizeIs(2));
  Segmentation const none = cluster(frame, normals, {.min_pixels = 101});
  EXPECT_THAT(none.stuff, IsEmpty());
  EXPECT_THAT(none.labels, Each(kUnassigned));
}

TEST(ClusterStuff, CountsThePixelsThatTakeItsLabelAtTheEnd) {
  Frame const frame = two_boards();
  NormalMap normals = facing_normals(frame);
  for (int v = 0; v < 10; ++v) {
    for (int u = 7; u < 13; ++u) {
      normals.set(normals.x.index({u, v}), Eigen::Vector3f::Constant(kNaN));
    }
  }
  Segmentation const one_step = cluster(frame, normals, {.min_pixels = 25, .spread_px = 1});
  ASSERT_THAT(one_step.stuff, SizeIs(2));
  EXPECT_EQ(one_step.stuff[0].pixel_count, 80U);
  Segmentation const all = cluster(frame, normals);
  EXPECT_EQ(all.stuff[0].pixel_count, 100U);
  EXPECT_EQ(all.stuff[1].pixel_count, 100U);
  EXPECT_TRUE(all.labels == cluster(frame, facing_normals(frame)).labels);
  EXPECT_FLOAT_EQ(all.stuff[0].bounds_world.max().x(), 0.09F);
}

TEST(ClusterStuff, ClustersAgreeWithTheLabelImage) {
  Frame const frame = two_boards();
  NormalMap normals = facing_normals(frame);
  for (std::size_t i = 0; i < normals.size(); i += 3) {
    normals.set(i, Eigen::Vector3f(static_cast<float>(i % 7) - 3.0F, 0.0F, -5.0F).normalized());
  }
  Segmentation const result = cluster(frame, normals, {.radius_m = 0.02, .min_pixels = 2});
  ASSERT_GT(result.stuff.size(), 2U);
  for (std::size_t i = 0; i < result.stuff.size(); ++i) {
    StuffCluster const& stuff = result.stuff[i];
    EXPECT_EQ(stuff.label, kFirstStuff + i);
    EXPECT_EQ(stuff.pixel_count, static_cast<std::size_t>(std::count(
                                     result.labels.begin(), result.labels.end(), stuff.label)));
    EXPECT_TRUE(stuff.bounds_world.contains(stuff.centroid_world));
  }
}

TEST(ClusterStuff, CentroidOfAFlatClusterStaysInItsBounds) {
  for (float const depth_m : {0.1F, 0.7F, 1.1F, 2.3F, 3.3F}) {
    Frame const frame = frame_of(9, 7, std::vector<float>(9, depth_m));
    Segmentation const before = unassigned_segmentation(
        frame, Se3(Eigen::Quaterniond(0.9, 0.1, 0.3, 0.2), {0.1, 0.2, 0.3}), kPriorFrame);
    Segmentation const result =
        cluster_stuff(frame, facing_normals(frame), before, {.min_pixels = 25});
    ASSERT_THAT(result.stuff, SizeIs(1));
    EXPECT_TRUE(result.stuff[0].bounds_world.contains(result.stuff[0].centroid_world));
  }
}

TEST(ClusterStuff, KeepsTheLargestWhereLabelsRunOut) {
  constexpr int kWidth = 400;
  constexpr int kHeight = 160;
  static_assert(static_cast<std::size_t>(kWidth) * kHeight > kMaxStuff);
  Frame frame;
  frame.cloud_camera = OrganizedCloud(kWidth, kHeight);
  for (std::size_t i = 0; i < frame.cloud_camera.size(); ++i) {
    // Each point is alone, but for the last two.
    Pixel const pixel = frame.cloud_camera.x.pixel(std::min(i, frame.cloud_camera.size() - 2));
    frame.cloud_camera.set(
        i, {0.1F * static_cast<float>(pixel.u), 0.1F * static_cast<float>(pixel.v), 1.0F});
  }
  Segmentation const result = cluster(frame, facing_normals(frame), {.min_pixels = 1});
  ASSERT_THAT(result.stuff, SizeIs(kMaxStuff));
  EXPECT_EQ(result.stuff.back().label, 65535);
  EXPECT_EQ(result.stuff.back().pixel_count, 2U);
  EXPECT_EQ(result.labels[kMaxStuff - 2], 65534);
  EXPECT_EQ(result.labels[kMaxStuff - 1], kUnassigned);
}

TEST(ClusterStuff, DegenerateFrames) {
  Frame empty;
  EXPECT_THAT(cluster(empty, NormalMap()).stuff, IsEmpty());
  Frame blind;
  blind.cloud_camera = OrganizedCloud(12, 9);
  Segmentation const nothing = cluster(blind, NormalMap(12, 9));
  EXPECT_THAT(nothing.stuff, IsEmpty());
  EXPECT_THAT(nothing.labels, Each(kNoDepth));
  Frame const pixel = frame_of(1, 1, {1.0F});
  EXPECT_THAT(cluster(pixel, NormalMap(1, 1)).labels, Each(kUnassigned));
  Segmentation const one = cluster(pixel, facing_normals(pixel), {.min_pixels = 1});
  ASSERT_THAT(one.stuff, SizeIs(1));
  EXPECT_THAT(one.stuff[0].points_world, SizeIs(1));
}

TEST(ClusterStuff, RefusesABrokenContract) {
  Frame const frame = two_boards();
  EXPECT_THROW(cluster(frame, NormalMap(20, 9)), std::logic_error);
  Segmentation before = unassigned_segmentation(frame, Se3(), kPriorFrame);
  before.stuff.emplace_back();
  EXPECT_THROW(static_cast<void>(cluster_stuff(frame, facing_normals(frame), before, {})),
               std::logic_error);
  before = unassigned_segmentation(frame, Se3(), kPriorFrame);
  before.labels = LabelMap(3, 3);
  EXPECT_THROW(static_cast<void>(cluster_stuff(frame, facing_normals(frame), before, {})),
               std::logic_error);
}

}  // namespace
}  // namespace credo
