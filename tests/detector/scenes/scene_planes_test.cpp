#include "detector/scenes/scene_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::test {
namespace {

using Eigen::Vector3f;

constexpr int kWidth = 320;
constexpr int kHeight = 240;

/// A wall a metre away that the camera looks straight at, all one segment; a disc of 40 pixels
/// radius in its middle stands `raised_m` before it and is of the same segment.
SearchScene wall_with_disc(float raised_m) {
  SearchScene scene;
  scene.intrinsics = {262.5, 262.5, 159.5, 119.5};
  scene.pixels = Grid<ScenePixel>(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      ScenePixel& pixel = scene.pixels[{u, v}];
      bool const disc = std::hypot(u - 160, v - 120) < 40.0;
      pixel.depth_m = disc ? 1.0F - raised_m : 1.0F;
      pixel.normal = {0, 0, -127};
      pixel.segment = 1;
    }
  }
  return scene;
}

TEST(ScenePlanes, WhatRunsIntoAPlanesSegmentDoesNotHideIt) {
  SearchScene scene = wall_with_disc(0.05F);
  scene.planes = large_planes(points_of_segments(scene, 1), scene.pixels.size());
  ASSERT_EQ(scene.planes.size(), 1U);
  EXPECT_NEAR(scene.planes[0].offset_m, -1.0F, 1e-3F);
  EXPECT_LT((scene.planes[0].normal_camera + Vector3f::UnitZ()).norm(), 1e-3F);
  EXPECT_NEAR(scene.planes[0].extent_m, 320.0F / 262.5F, 0.12F);
  mark_planes(scene);
  EXPECT_EQ((scene.pixels[Pixel{10, 10}].plane), 0);
  EXPECT_EQ((scene.pixels[Pixel{160, 120}].plane), kNoPlane);
}

TEST(ScenePlanes, WhatStandsOffAPlaneIsASegmentOfItsOwn) {
  SearchScene scene = wall_with_disc(0.05F);
  scene.planes = large_planes(points_of_segments(scene, 1), scene.pixels.size());
  mark_planes(scene);
  EXPECT_EQ(split_from_planes(scene, 1), 2U);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      bool const disc = std::hypot(u - 160, v - 120) < 40.0;
      ASSERT_EQ((scene.pixels[Pixel{u, v}].segment), disc ? 2 : 1) << u << ' ' << v;
    }
  }
}

TEST(ScenePlanes, MarkedAnewOnlyTheNewPlanesCount) {
  SearchScene scene = wall_with_disc(0.05F);
  scene.planes = large_planes(points_of_segments(scene, 1), scene.pixels.size());
  mark_planes(scene);
  ASSERT_EQ((scene.pixels[Pixel{10, 10}].plane), 0);
  scene.planes.clear();
  mark_planes(scene);
  EXPECT_EQ((scene.pixels[Pixel{10, 10}].plane), kNoPlane);
}

// Two steps up the wall, each of them flat and next to the other.
TEST(ScenePlanes, WhatStandsOffAtAnotherDepthIsAnother) {
  SearchScene scene = wall_with_disc(0.05F);
  for (int v = 100; v < 140; ++v) {
    for (int u = 160; u < 190; ++u) {
      scene.pixels[{u, v}].depth_m = 0.85F;
    }
  }
  scene.planes = large_planes(points_of_segments(scene, 1), scene.pixels.size());
  mark_planes(scene);
  EXPECT_EQ(split_from_planes(scene, 1), 3U);
}

TEST(ScenePlanes, TwoThingsThatStandOffApartAreTwo) {
  SearchScene scene = wall_with_disc(0.05F);
  for (int v = 20; v < 40; ++v) {
    for (int u = 20; u < 40; ++u) {
      scene.pixels[{u, v}].depth_m = 0.93F;
    }
  }
  scene.planes = large_planes(points_of_segments(scene, 1), scene.pixels.size());
  mark_planes(scene);
  EXPECT_EQ(split_from_planes(scene, 1), 3U);
  EXPECT_NE((scene.pixels[Pixel{30, 30}].segment), (scene.pixels[Pixel{160, 120}].segment));
}

TEST(ScenePlanes, ScrapsStayWithTheirPlane) {
  SearchScene scene = wall_with_disc(0.0F);
  for (int u = 20; u < 70; ++u) {
    scene.pixels[{u, 30}].depth_m = 0.95F;  // 50 pixels in a row
  }
  scene.planes = large_planes(points_of_segments(scene, 1), scene.pixels.size());
  mark_planes(scene);
  EXPECT_EQ(split_from_planes(scene, 1), 1U);
  EXPECT_EQ((scene.pixels[Pixel{30, 30}].segment), 1);
}

TEST(ScenePlanes, WhatIsTooNearToTheNoiseIsThePlane) {
  SearchScene scene = wall_with_disc(0.006F);
  scene.planes = large_planes(points_of_segments(scene, 1), scene.pixels.size());
  mark_planes(scene);
  EXPECT_EQ((scene.pixels[Pixel{160, 120}].plane), 0);
  EXPECT_EQ(split_from_planes(scene, 1), 1U);
}

TEST(ScenePlanes, APillarIsNone) {
  // Of 20 cm radius, half a metre high, 1.2 m away: large, and half of it within centimetres of
  // its nearest line.
  SearchScene scene = wall_with_disc(0.0F);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      ScenePixel& pixel = scene.pixels[{u, v}];
      double const slope = (u - 159.5) / 262.5;
      // The nearer root of (slope z)^2 + (z - 1.2)^2 = 0.2^2.
      double const a = 1.0 + slope * slope;
      double const root = 1.2 * 1.2 - a * (1.2 * 1.2 - 0.2 * 0.2);
      pixel = ScenePixel{};
      if (root > 0.0) {
        double const z = (1.2 - std::sqrt(root)) / a;
        pixel.depth_m = static_cast<float>(z);
        Vector3f const normal =
            Vector3f(static_cast<float>(slope * z), 0.0F, static_cast<float>(z - 1.2)) / 0.2F;
        for (int i = 0; i < 3; ++i) {
          pixel.normal.at(static_cast<std::size_t>(i)) =
              static_cast<std::int8_t>(std::lround(normal[i] * 127.0F));
        }
        pixel.segment = 1;
      }
    }
  }
  EXPECT_TRUE(large_planes(points_of_segments(scene, 1), scene.pixels.size()).empty());
}

TEST(ScenePlanes, SmallOnesAreNone) {
  SearchScene scene = wall_with_disc(0.0F);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (u >= 36 || v >= 36) {
        scene.pixels[{u, v}] = ScenePixel{};  // 14 cm are left, under 2 % of the image
      }
    }
  }
  EXPECT_TRUE(large_planes(points_of_segments(scene, 1), scene.pixels.size()).empty());
  EXPECT_TRUE(large_planes({}, 0).empty());
}

TEST(ScenePlanes, TheLargestSegmentsComesFirst) {
  SearchScene scene = wall_with_disc(0.0F);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 200; u < kWidth; ++u) {
      scene.pixels[{u, v}].depth_m = 1.5F;
      scene.pixels[{u, v}].segment = 2;
    }
    for (int u = 0; u < 60; ++u) {
      scene.pixels[{u, v}].segment = 3;
    }
  }
  auto const planes = large_planes(points_of_segments(scene, 3), scene.pixels.size());
  ASSERT_EQ(planes.size(), 3U);
  EXPECT_EQ(planes[0].segment, 1);
  EXPECT_EQ(planes[1].segment, 2);
  EXPECT_EQ(planes[2].segment, 3);
  scene.planes = planes;
  mark_planes(scene);
  EXPECT_EQ((scene.pixels[Pixel{30, 30}].plane), 0) << "the first that it lies on";
}

}  // namespace
}  // namespace credo::test
