// Against shares computed by hand. Plates face the camera, which looks along +x from 1 m above the
// origin: a metre at 3 m is 20 pixels wide.
#include "sim/visibility.hpp"

#include <gtest/gtest.h>

#include "sim/camera_path.hpp"
#include "sim/scenes.hpp"

namespace credo::test {
namespace {

/// A thin plate: y and z are its middle's.
SceneThing plate(std::string name, double width_m, double height_m, double x, double y, double z) {
  return thing(std::move(name), SceneShape::kBox, {1e-4, width_m, height_m},
               {x, y, z - height_m / 2});
}

double fraction_of_first(Scene const& scene) {
  return visible_fraction(RayCaster(scene), 0, camera_pose(scene.camera.path, 0.0));
}

double fraction_of_first(std::vector<SceneThing> things) {
  return fraction_of_first(small_scene(std::move(things)));
}

SceneThing const kPlate = plate("plate", 0.6, 0.6, 3, 0, 1);

TEST(Visibility, WhatStandsAloneInThePictureIsWhollySeen) {
  EXPECT_EQ(fraction_of_first({kPlate}), 1.0);
  EXPECT_EQ(fraction_of_first({thing("ball", SceneShape::kSphere, {0.3}, {2, 0.2, 0.8})}), 1.0);
  EXPECT_EQ(fraction_of_first(
                {thing("table", SceneShape::kTable, {0.8, 1, 0.7, 0.04, 0.06}, {3, 0, 0.3})}),
            1.0)
      << "its own top hides its legs, that is no loss";
}

TEST(Visibility, WhatStandsBehindDoesNotMatter) {
  EXPECT_EQ(fraction_of_first({kPlate, plate("wall", 9, 9, 4, 0, 1)}), 1.0);
}

TEST(Visibility, HalfBehindAWallIsHalf) {
  EXPECT_NEAR(fraction_of_first({kPlate, plate("wall", 4, 4, 2, 2, 1)}), 0.5, 1e-12);
  EXPECT_NEAR(fraction_of_first({kPlate, plate("wall", 4, 4, 2, 0, -1)}), 0.5, 1e-12);
}

TEST(Visibility, HalfOutsideThePictureIsHalf) {
  // The left edge is 32 / 60 beside the axis, the lower one 24 / 62 below it.
  EXPECT_NEAR(fraction_of_first({plate("plate", 0.6, 0.6, 3, 1.6, 1)}), 0.5, 1e-12);
  EXPECT_NEAR(fraction_of_first({plate("plate", 0.6, 0.6, 3.1, 0, 1 - 1.2)}), 0.5, 1e-12);
}

TEST(Visibility, TwiceAsWideAsThePictureIsHalf) {
  // Every third pixel is asked in a rectangle so wide: one column more or less of 40.
  EXPECT_NEAR(fraction_of_first({plate("plate", 6.4, 0.6, 3, 0, 1)}), 0.5, 1.0 / 40);
}

TEST(Visibility, OutOfViewIsNone) {
  EXPECT_EQ(fraction_of_first({plate("plate", 0.6, 0.6, -3, 0, 1)}), 0.0) << "behind";
  EXPECT_EQ(fraction_of_first({plate("plate", 0.6, 0.6, 3, 2.5, 1)}), 0.0) << "just beside";
  EXPECT_EQ(fraction_of_first({plate("plate", 0.6, 0.6, 1e-3, 900, 1)}), 0.0) << "far beside";
}

TEST(Visibility, BehindAnotherIsNone) {
  EXPECT_EQ(fraction_of_first({kPlate, plate("wall", 1, 1, 2, 0, 1)}), 0.0);
  EXPECT_EQ(fraction_of_first({kPlate, plate("hand", 1, 1, 0.2, 0, 1)}), 0.0)
      << "what is too near to be measured hides too";
}

TEST(Visibility, AbsentIsNoneAndHidesNothing) {
  Scene scene = small_scene({kPlate, plate("wall", 1, 1, 2, 0, 1)});
  scene.events = {{0, "wall", SceneChange::kRemoved, {}, {}, {}}};
  EXPECT_EQ(fraction_of_first(scene), 1.0);
  scene.events = {{0, "plate", SceneChange::kRemoved, {}, {}, {}}};
  EXPECT_EQ(fraction_of_first(scene), 0.0);
}

TEST(Visibility, OutOfTheRangeOfDepthIsNone) {
  EXPECT_EQ(fraction_of_first({plate("plate", 0.1, 0.1, 0.39, 0, 1)}), 0.0);
  EXPECT_EQ(fraction_of_first({plate("plate", 0.1, 0.1, 0.41, 0, 1)}), 1.0);
  EXPECT_EQ(fraction_of_first({plate("plate", 2, 2, 7.9, 0, 1)}), 1.0);
  EXPECT_EQ(fraction_of_first({plate("plate", 2, 2, 8.1, 0, 1)}), 0.0);
}

TEST(Visibility, AFloorUnderTheCameraCountsOnePictureBeyondTheEdges) {
  // Rows 24 to 95 and columns -64 to 127 are floor; in the picture and within 8 m are rows 32 to
  // 47, columns 0 to 63. Every third pixel is looked at.
  EXPECT_NEAR(fraction_of_first({thing("floor", SceneShape::kBox, {99, 99, 0.1}, {0, 0, -0.1})}),
              16.0 / 72.0 / 3.0, 0.01);
}

TEST(Visibility, OfALargePictureSomeRaysAreEnough) {
  Scene scene = small_scene({plate("plate", 2, 1.5, 3, 0.1, 1), plate("post", 0.4, 9, 2, 0.05, 1)});
  scene.camera = SceneCamera{};
  scene.camera.path = {{0.0, {0, 0, 1}, {1, 0, 1}}};
  // The post's shadow at 3 m is 0.6 m of 2 m.
  EXPECT_NEAR(fraction_of_first(scene), 0.7, 0.02);
}

}  // namespace
}  // namespace credo::test
