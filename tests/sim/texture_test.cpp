#include "sim/texture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/camera_path.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scenes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;
using Kind = SceneTexture::Kind;

double shade(Kind kind, Vector3d const& p, std::uint32_t seed = 1) {
  return texture_shade({kind, 0.1}, seed, p);
}

TEST(Texture, PlainIsOneShade) {
  EXPECT_EQ(shade(Kind::kPlain, {0.3, 0.1, 2}), 1.0);
}

TEST(Texture, ACheckerChangesFromCubeToCube) {
  double const first = shade(Kind::kChecker, {0.05, 0.05, 0.05});
  EXPECT_EQ(first, 1.0);
  EXPECT_EQ(shade(Kind::kChecker, {0.09, 0.01, 0.05}), first);
  EXPECT_LT(shade(Kind::kChecker, {0.15, 0.05, 0.05}), first);
  EXPECT_LT(shade(Kind::kChecker, {0.05, 0.05, -0.05}), first);
  EXPECT_EQ(shade(Kind::kChecker, {0.15, -0.05, 0.05}), first);
  EXPECT_EQ(shade(Kind::kChecker, {0.05, 0.05, 0.1 - 1e-12}),
            shade(Kind::kChecker, {0.05, 0.05, 0.1 + 1e-12}))
      << "a face on a border is of one shade";
}

TEST(Texture, StripesRunUpAndAreAsWideAsTheyShould) {
  Vector3d const across = Vector3d(1, 1, 0).normalized();
  for (double const z : {-1.0, 0.0, 0.4}) {
    Vector3d const up = z * Vector3d::UnitZ() + 0.3 * Vector3d(1, -1, 0);
    EXPECT_EQ(shade(Kind::kStripes, 0.05 * across + up), 1.0);
    EXPECT_LT(shade(Kind::kStripes, 0.15 * across + up), 1.0);
    EXPECT_LT(shade(Kind::kStripes, -0.05 * across + up), 1.0);
    EXPECT_EQ(shade(Kind::kStripes, 0.25 * across + up), 1.0);
  }
}

TEST(Texture, NoiseIsSmoothAndFillsItsRange) {
  double least = 1.0;
  double greatest = 0.0;
  double before = shade(Kind::kNoise, {-10, 0.33, -0.2});
  for (int i = 1; i < 20000; ++i) {
    double const now = shade(Kind::kNoise, {0.001 * i - 10, 0.33, -0.2});
    // The steepest smooth step of the whole range in a cell is 1.5 of it.
    ASSERT_LT(std::abs(now - before), 0.4 * 1.5 * 0.01 + 1e-9);
    before = now;
    least = std::min(least, now);
    greatest = std::max(greatest, now);
  }
  EXPECT_GE(least, 0.6);
  EXPECT_LE(greatest, 1.0);
  EXPECT_GT(greatest - least, 0.25);
}

TEST(Texture, NoiseIsOfTheName) {
  EXPECT_EQ(texture_seed("table"), texture_seed("table"));
  std::set<double> shades;
  for (char const* const name : {"table", "tabel", "chair", ""}) {
    shades.insert(shade(Kind::kNoise, {0.42, 0.13, 0.77}, texture_seed(name)));
  }
  EXPECT_EQ(shades.size(), 4U);
  EXPECT_EQ(texture_seed("a"), 0xe40c292cU) << "as published for FNV-1a";
}

TEST(Texture, ChangesColourAndNothingElse) {
  SceneThing wall = thing("wall", SceneShape::kBox, {1, 99, 99}, {3.5, 0, -50});
  RenderedView const plain =
      RayCaster(small_scene({wall})).render(camera_pose(small_scene({wall}).camera.path, 0.0));
  for (Kind const kind : {Kind::kChecker, Kind::kStripes, Kind::kNoise}) {
    wall.texture = {kind, 0.3};
    Scene const scene = small_scene({wall});
    RenderedView const view = RayCaster(scene).render(camera_pose(scene.camera.path, 0.0));
    std::size_t other = 0;
    for (std::size_t i = 0; i < view.depth_m.size(); ++i) {
      ASSERT_EQ(view.depth_m[i], plain.depth_m[i]);
      ASSERT_EQ(view.thing[i], plain.thing[i]);
      ASSERT_LE(view.color[i][0], plain.color[i][0]);
      other += view.color[i] != plain.color[i] ? 1 : 0;
    }
    EXPECT_GT(other, view.color.size() / 3);
  }
}

}  // namespace
}  // namespace credo::test
