#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "stages/normals/normals.hpp"
#include "support/literal_normals.hpp"
#include "support/rendered_scene.hpp"

namespace credo {
namespace {

using test::kinect_intrinsics;

// Float sums over at most 100 samples against double ones, in a vector of length 1.
constexpr float kFloatSums = 1e-5F;

void expect_twin(Grid<float> const& depth_m, NormalsConfig const& config, std::string const& what) {
  SCOPED_TRACE(what);
  auto const twin = test::literal_normals(depth_m, kinect_intrinsics(), config);
  NormalMap const normals =
      estimate_normals(cloud_from_depth(depth_m, kinect_intrinsics()), kinect_intrinsics(), config);
  std::size_t undecided = 0;
  std::size_t wrong = 0;
  float worst = 0.0F;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (twin.undecided[i] != 0) {
      ++undecided;
    } else if (normals.valid(i) != twin.normals.valid(i)) {
      ++wrong;
    } else if (normals.valid(i)) {
      worst = std::max(worst, (normals.at(i) - twin.normals.at(i)).norm());
    }
  }
  EXPECT_EQ(wrong, 0) << "pixels are NaN in one of the two only";
  EXPECT_LT(worst, kFloatSums);
  EXPECT_LE(undecided, depth_m.size() / 1000);
}

/// A window of the room around one of its corners, so that the slow twin stays quick.
Grid<float> part_of(Grid<float> const& image, Pixel corner, int width, int height) {
  Grid<float> part(width, height);
  for (std::size_t i = 0; i < part.size(); ++i) {
    Pixel const p = part.pixel(i);
    part[i] = image[Pixel{corner.u + p.u, corner.v + p.v}];
  }
  return part;
}

TEST(NormalsTwin, AgreesOnTheNoisyRoom) {
  auto const room = test::render(test::room_scene(), 640, 480, kinect_intrinsics());
  Grid<float> const noisy = test::with_kinect_noise(room.depth_m, 3);
  expect_twin(part_of(noisy, {120, 40}, 161, 121), {}, "boxes");
  expect_twin(part_of(noisy, {240, 90}, 159, 119), {}, "ball");
  expect_twin(part_of(noisy, {440, 80}, 200, 120), {}, "corner");
}

TEST(NormalsTwin, AgreesOnTheNoiselessRoom) {
  auto const room = test::render(test::room_scene(), 640, 480, kinect_intrinsics());
  expect_twin(part_of(room.depth_m, {240, 90}, 160, 120), {}, "ball");
}

TEST(NormalsTwin, AgreesAtEveryWindowSizeAndOnNonsense) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> scatter(0.97F, 1.03F);
  std::bernoulli_distribution hole(0.2);
  for (float const depth_m : {0.15F, 0.4F, 0.9F, 1.7F, 4.0F, 9.9F}) {
    Grid<float> depth(63, 47);
    for (float& z : depth) {
      z = hole(random) ? 0.0F : depth_m * scatter(random);
    }
    expect_twin(depth, {}, "depth " + std::to_string(depth_m));
    NormalsConfig wide;
    wide.max_depth_jump_m = 0.2F;
    wide.min_support = 0.5F;
    wide.min_radius_px = 2.0F;
    expect_twin(depth, wide, "wide, depth " + std::to_string(depth_m));
  }
}

}  // namespace
}  // namespace credo
