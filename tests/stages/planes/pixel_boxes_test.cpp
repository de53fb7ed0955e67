#include "stages/planes/pixel_boxes.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "stages/planes/small_shots.hpp"

namespace credo {
namespace {

/// Rough ground with holes, at depths of 0.5 to 4 m.
OrganizedCloud some_cloud(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  OrganizedCloud cloud(width, height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i % 5 != 3 && i / 100 % 7 != 2) {
      auto const [u, v] = cloud.x.pixel(i);
      cloud.set(i, {0.01F * static_cast<float>(u) - 1.0F, 0.01F * static_cast<float>(v) - 1.0F,
                    2.0F + 0.01F * static_cast<float>(v) + 0.05F * unit(random)});
    }
  }
  return cloud;
}

PixelSet valid_pixels(OrganizedCloud const& cloud) {
  return test::pixels_where(cloud.size(), [&](std::size_t i) { return cloud.valid(i); }).pixels;
}

void expect_no_inlier_left_out() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::size_t words = 0;
  std::size_t near_words = 0;
  for (unsigned k = 0; k < 200; ++k) {
    // Some end within a word, some have no pixel at all.
    OrganizedCloud const cloud = some_cloud(static_cast<int>(40 * (k % 6)), 61, k);
    NormalMap const normals(cloud.width(), cloud.height());
    PixelSet const valid = valid_pixels(cloud);
    Plane const plane{Eigen::Vector3d(unit(random), unit(random), unit(random)).normalized(),
                      2.0 * unit(random)};
    PlaneTolerance const tolerance{0.01F, 4.0F * static_cast<float>(k % 2), 0.0F};
    PixelSet const near = PixelBoxes(cloud).near(plane, valid, tolerance);
    CountedPixels const some = plane_inliers(plane, cloud, normals, near, tolerance);
    CountedPixels const all = plane_inliers(plane, cloud, normals, valid, tolerance);
    EXPECT_EQ(some.count, all.count);
    EXPECT_TRUE(std::ranges::equal(some.pixels.words(), all.pixels.words()));
    for (std::size_t w = 0; w < valid.words().size(); ++w) {
      EXPECT_TRUE(near.words()[w] == 0 || near.words()[w] == valid.words()[w]);
      words += valid.words()[w] != 0 ? 1 : 0;
      near_words += near.words()[w] != 0 ? 1 : 0;
    }
  }
  EXPECT_LT(4 * near_words, words);
}

TEST(PixelBoxes, LeaveNoInlierOutOnEveryInstructionSet) {
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    expect_no_inlier_left_out();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(PixelBoxes, TellWhatLiesBehindToTheBit) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::size_t words = 0;
  std::size_t open_words = 0;
  for (unsigned k = 0; k < 200; ++k) {
    OrganizedCloud const cloud = some_cloud(static_cast<int>(40 * (k % 6)), 61, k);
    PixelSet const valid = valid_pixels(cloud);
    Plane const plane{Eigen::Vector3d(unit(random), unit(random), unit(random)).normalized(),
                      2.0 * unit(random)};
    PlaneTolerance const tolerance{0.01F, 4.0F * static_cast<float>(k % 2), 0.0F};
    auto [behind, open] = PixelBoxes(cloud).behind(plane, valid, tolerance);
    behind.insert(pixels_behind(plane, cloud, open, tolerance));
    CountedPixels const all = pixels_behind(plane, cloud, valid, tolerance);
    EXPECT_EQ(behind.count, all.count);
    EXPECT_TRUE(std::ranges::equal(behind.pixels.words(), all.pixels.words()));
    for (std::size_t w = 0; w < valid.words().size(); ++w) {
      words += valid.words()[w] != 0 ? 1 : 0;
      open_words += open.words()[w] != 0 ? 1 : 0;
    }
  }
  EXPECT_LT(4 * open_words, words);
}

TEST(PixelBoxes, KeepWhatLiesOnTheLimitToTheBit) {
  OrganizedCloud cloud(64, 1);
  float const step_m = 0.1F;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.set(i, {0.3F, 0.7F, 1.0F + step_m});
  }
  NormalMap const normals(64, 1);
  PixelSet const valid = valid_pixels(cloud);
  Plane const plane{Eigen::Vector3d::UnitZ(), 1.0};
  float const distance_m = 1.0F + step_m - 1.0F;
  for (float const limit_m : {distance_m, std::nextafter(distance_m, 0.0F)}) {
    PlaneTolerance const tolerance{limit_m, 0.0F, 0.0F};
    PixelSet const near = PixelBoxes(cloud).near(plane, valid, tolerance);
    EXPECT_EQ(near.contains(0), limit_m == distance_m);
    EXPECT_EQ(plane_inliers(plane, cloud, normals, valid, tolerance).count,
              limit_m == distance_m ? 64U : 0U);
  }
}

}  // namespace
}  // namespace credo
