#include "geometry/sight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace credo {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Grid<float> some_depth(int width, int height) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.5F, 4.0F);
  Grid<float> depth_m(width, height);
  for (float& z : depth_m) {
    z = uniform(random);
    z = z < 1.0F ? 0.0F : z > 3.8F ? kNan : z > 3.6F ? kInf : z;
  }
  return depth_m;
}

/// As the comments of Sight say it, block by block.
void expect_as_said(Sight const& sight, Grid<float> const& depth_m, LabelMap const& labels) {
  int const b = sight.block_px;
  for (int v = 0; v < sight.depth_m.height(); ++v) {
    for (int u = 0; u < sight.depth_m.width(); ++u) {
      Pixel const middle{u * b + b / 2, v * b + b / 2};
      float const z = depth_m[middle];
      EXPECT_EQ((sight.depth_m[{u, v}]), std::isfinite(z) && z > 0 ? z : 0.0F);
      EXPECT_EQ((sight.labels[{u, v}]), labels[middle]);
      float nearest = kInf;
      int const last_v = std::min((v + 2) * b, sight.depth_m.height() * b);
      int const last_u = std::min((u + 2) * b, sight.depth_m.width() * b);
      for (int y = std::max(0, (v - 1) * b); y < last_v; ++y) {
        for (int x = std::max(0, (u - 1) * b); x < last_u; ++x) {
          float const here = depth_m[{x, y}];
          nearest = here > 0.0F ? std::min(nearest, here) : nearest;
        }
      }
      EXPECT_EQ((sight.nearest_m[{u, v}]), nearest) << u << " " << v;
    }
  }
}

TEST(Sight, IsAsSaidWhateverTheSize) {
  for (auto const& [width, height, block] :
       {std::array{640, 480, 4}, {160, 120, 1}, {1280, 960, 8}, {321, 243, 2}, {7, 5, 1}}) {
    Grid<float> const depth_m = some_depth(width, height);
    LabelMap labels(width, height);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i] = static_cast<LabelCode>(i % 5000);
    }
    Sight const sight = sight_of(depth_m, labels, {525, 520, 319, 239});
    EXPECT_EQ(sight.block_px, block);
    EXPECT_EQ(sight.intrinsics, (CameraIntrinsics{525, 520, 319, 239}));
    EXPECT_EQ(sight.depth_m.width(), width / block);
    EXPECT_EQ(sight.depth_m.height(), height / block);
    expect_as_said(sight, depth_m, labels);
  }
}

TEST(Sight, OfNothingIsNothing) {
  EXPECT_TRUE(sight_of({}, {}, {525, 525, 0, 0}).depth_m.empty());
  EXPECT_THROW(sight_of(Grid<float>(2, 2), LabelMap(2, 1), {525, 525, 0, 0}), std::logic_error);
}

TEST(MiddleNormals, AreThoseOfEachBlocksMiddlePixel) {
  LabelMap const labels(330, 250, kUnassigned);
  Sight const sight = sight_of(some_depth(330, 250), labels, {});
  NormalMap normals(330, 250);
  for (std::size_t i = 0; i < normals.size(); i += 2) {
    normals.set(i, {static_cast<float>(i), 1.0F, -1.0F});
  }
  NormalMap const middle = middle_normals(normals, sight);
  ASSERT_TRUE(middle.x.same_size(sight.depth_m));
  for (std::size_t i = 0; i < middle.size(); ++i) {
    std::size_t const pixel = normals.x.index(sight.middle_of(middle.x.pixel(i)));
    EXPECT_EQ(middle.valid(i), normals.valid(pixel));
    EXPECT_TRUE(!middle.valid(i) || middle.at(i) == normals.at(pixel));
  }
}

TEST(MiddleNormals, OfASmallerImageAreRefused) {
  LabelMap const labels(320, 240, kUnassigned);
  Sight const sight = sight_of(some_depth(320, 240), labels, {});
  EXPECT_THROW((void)middle_normals(NormalMap(318, 240), sight), std::logic_error);
  EXPECT_THROW((void)middle_normals(NormalMap(320, 238), sight), std::logic_error);
  EXPECT_TRUE(middle_normals({}, Sight{}).empty());
}

}  // namespace
}  // namespace credo
