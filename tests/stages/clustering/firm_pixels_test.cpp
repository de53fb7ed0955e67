#include "stages/clustering/firm_pixels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stages/clustering/clustering.hpp"

namespace credo::test {
namespace {

using ::testing::Each;
using ::testing::SizeIs;

constexpr LabelCode kThing = kFirstStuff;

TEST(FirmPixels, AreThoseThatHoldTogether) {
  Grid<float> depth_m(8, 6, 1.0F);
  LabelMap const labels(8, 6, kThing);
  depth_m[{3, 2}] = 3.0F;
  depth_m[{4, 2}] = 3.0F;
  Grid<std::uint8_t> const firm = firm_pixels(depth_m, labels);
  for (std::size_t i = 0; i < firm.size(); ++i) {
    EXPECT_EQ(firm[i], depth_m[i] > 2.0F ? 0 : 1) << i;
  }
}

TEST(FirmPixels, BothHalvesOfAThingThatIsCutInTwoAreFirmAndFloorIsNoStuff) {
  LabelMap labels(9, 3, kThing);
  for (int v = 0; v < 3; ++v) {
    labels[{6, v}] = kFloor;
  }
  Grid<std::uint8_t> const firm = firm_pixels(Grid<float>(9, 3, 2.0F), labels);
  for (std::size_t i = 0; i < firm.size(); ++i) {
    EXPECT_EQ(firm[i], labels[i] == kThing ? 1 : 0);
  }
}

TEST(FirmPixels, ASlantedSurfaceIsFirmAsFarAsAKinectGoes) {
  Grid<float> depth_m(10, 6);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    depth_m[i] = 1.0F / (0.25F + 0.005F * static_cast<float>(depth_m.pixel(i).u));
  }
  EXPECT_THAT(firm_pixels(depth_m, LabelMap(10, 6, kThing)), Each(1));
}

TEST(FirmPixels, WhatFallsApartAltogetherIsAllFirm) {
  Grid<float> depth_m(6, 6);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    depth_m[i] = 1.0F / (0.1F + 0.03F * static_cast<float>(i));
  }
  EXPECT_THAT(firm_pixels(depth_m, LabelMap(6, 6, kThing)), Each(1));
}

// A bottle at 2 m with one pixel of the wall behind it.
TEST(FirmPixels, KeepABottlesBoundsToTheBottle) {
  Frame frame;
  Grid<float> depth_m(20, 20, 2.0F);
  depth_m[{0, 5}] = 5.0F;
  frame.cloud_camera = cloud_from_depth(depth_m, frame.intrinsics);
  Segmentation before = unassigned_segmentation(frame, Se3(), kPriorFrame);
  before.segments.labels = Grid<std::int32_t>(20, 20, 1);
  before.segments.pixel_counts = {400};
  Segmentation const result = cluster_stuff(frame, NormalMap(20, 20), before, {});
  ASSERT_THAT(result.stuff, SizeIs(1));
  EXPECT_EQ(result.stuff[0].pixel_count, 400U);
  EXPECT_LT(result.stuff[0].bounds_world.max().z(), 2.01F);
  EXPECT_NEAR(result.stuff[0].centroid_world.z(), 2.0F, 1e-3F);
  EXPECT_THAT(result.labels, Each(kThing));
}

}  // namespace
}  // namespace credo::test
