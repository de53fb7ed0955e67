#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

#include "stages/segments/depth_images.hpp"
#include "stages/segments/segments.hpp"
#include "support/literal_convexity.hpp"
#include "support/rendered_scene.hpp"

namespace credo {
namespace {

constexpr double kFocal_px = 525.0;

/// Pixel for pixel; how many segments there are.
std::size_t expect_twin(Grid<float> const& depth_m, double focal_px, SegmentsConfig const& config,
                        std::string const& what) {
  Segments const fast = convex_segments(depth_m, focal_px, config);
  Segments const literal = test::literal_convex_segments(depth_m, focal_px, config);
  EXPECT_EQ(fast.pixel_counts, literal.pixel_counts) << what;
  EXPECT_TRUE(fast.labels == literal.labels) << what;
  return fast.pixel_counts.size();
}

TEST(ConvexityTwin, AgreesOnTheNoisyRoom) {
  CameraIntrinsics const camera = test::kinect_intrinsics();
  Grid<float> const room = test::render(test::room_scene(), 640, 480, camera).depth_m;
  for (unsigned const seed : {1U, 2U}) {
    EXPECT_GT(expect_twin(test::with_kinect_noise(room, seed), camera.fx_px, {}, "noisy room"), 8U);
  }
}

TEST(ConvexityTwin, AgreesOnTheNoiselessRoom) {
  CameraIntrinsics const camera = test::kinect_intrinsics();
  Grid<float> const room = test::render(test::room_scene(), 640, 480, camera).depth_m;
  EXPECT_GT(expect_twin(room, camera.fx_px, {}, "room"), 8U);
}

TEST(ConvexityTwin, AgreesOnFourTimesThePixels) {
  CameraIntrinsics const camera{1050.0, 1050.0, 639.5, 479.5};
  Grid<float> const room = test::render(test::room_scene(), 1280, 960, camera).depth_m;
  EXPECT_GT(expect_twin(test::with_kinect_noise(room, 4), camera.fx_px, {}, "large room"), 8U);
}

TEST(ConvexityTwin, AgreesOnRandomPlanes) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    EXPECT_GT(expect_twin(test::random_planes(211, 157, seed), kFocal_px, {},
                          "seed " + std::to_string(seed)),
              3U);
  }
}

TEST(ConvexityTwin, AgreesAtEverySizeOfImage) {
  constexpr Pixel kSizes[] = {{37, 23}, {23, 37}, {63, 65}, {64, 64},  {65, 63}, {129, 31},
                              {1, 1},   {1, 200}, {200, 1}, {2, 3},    {3, 2},   {16, 16},
                              {31, 33}, {33, 31}, {4, 150}, {150, 14}, {7, 90}};
  for (auto const [width, height] : kSizes) {
    std::string const what = std::to_string(width) + "x" + std::to_string(height);
    expect_twin(test::random_planes(width, height, 9), kFocal_px, {}, what);
    expect_twin(Grid<float>(width, height, 1.0F), kFocal_px, {}, what + ", flat");
  }
}

TEST(ConvexityTwin, AgreesForEveryLens) {
  // From less than a pixel to each length to more than the kernels reach.
  for (double const focal_px : {20.0, 200.0, 315.0, 585.0, 800.0, 1500.0, 6000.0}) {
    expect_twin(test::random_planes(160, 121, 5), focal_px, {}, std::to_string(focal_px) + " px");
  }
}

TEST(ConvexityTwin, AgreesAtTheLimitsOfTheConfig) {
  Grid<float> const depth_m = test::random_planes(160, 121, 6);
  SegmentsConfig small;
  small.link_quanta = 1.0;
  small.smooth_quanta = 1.0;
  small.smooth_radius_px = 0;
  small.reach_px = 2;
  small.reach_quanta = 1.0;
  small.crease_quanta = 0.1;
  small.crease_noise = 0.0;
  small.crease_slope = 0.0;
  small.disc_radius_px = 4;
  small.min_pixels = 1;
  expect_twin(depth_m, kFocal_px, small, "least");
  small.quantum_per_m = 0.1;
  expect_twin(depth_m, kFocal_px, small, "least, coarse");
  SegmentsConfig large;
  large.link_quanta = 100.0;
  large.smooth_quanta = 7.0;
  large.smooth_radius_px = 8;
  large.reach_px = 16;
  large.reach_quanta = 100.0;
  large.crease_quanta = 100.0;
  large.crease_noise = 10.0;
  large.crease_slope = 5.0;
  large.disc_radius_px = 50;
  large.min_pixels = 1000000;
  expect_twin(depth_m, kFocal_px, large, "most");
  large.crease_quanta = 0.1;
  large.quantum_per_m = 1e-5;
  expect_twin(depth_m, kFocal_px, large, "most, fine");
}

TEST(ConvexityTwin, AgreesOnPatternsAndNoise) {
  for (int const cell_px : {1, 2, 3, 9, 12}) {
    expect_twin(test::checkerboard(150, 110, cell_px), kFocal_px, {}, "checkerboard");
  }
  expect_twin(test::depth_noise(150, 110, 1), kFocal_px, {}, "noise");
  EXPECT_EQ(expect_twin(test::grooved_wall(160, 112), kFocal_px, {}, "grooves"), 1U);
}

TEST(ConvexityTwin, AgreesOnNonsense) {
  constexpr float kOdd[] = {0.0F,
                            -0.0F,
                            -1.0F,
                            std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::denorm_min(),
                            std::numeric_limits<float>::min(),
                            std::numeric_limits<float>::max(),
                            1e30F,
                            0.01F,
                            0.1F,
                            0.17F,
                            100.0F,
                            1e4F};
  for (float const odd : kOdd) {
    expect_twin(Grid<float>(70, 50, odd), kFocal_px, {}, std::to_string(odd));
  }
  std::mt19937 random(3);
  std::bernoulli_distribution is_odd(0.01);
  Grid<float> depth_m = test::random_planes(160, 120, 7);
  for (float& z : depth_m) {
    z = is_odd(random) ? kOdd[random() % std::size(kOdd)] : z;
  }
  EXPECT_GT(expect_twin(depth_m, kFocal_px, {}, "mixed"), 1U);
}

TEST(ConvexityTwin, AgreesVeryNearAndVeryFar) {
  Grid<float> const planes = test::random_planes(160, 120, 8);
  for (float const scale : {0.01F, 0.05F, 0.2F, 5.0F, 100.0F}) {
    Grid<float> depth_m = planes;
    for (float& z : depth_m) {
      z *= scale;
    }
    expect_twin(depth_m, kFocal_px, {}, "times " + std::to_string(scale));
  }
}

}  // namespace
}  // namespace credo
