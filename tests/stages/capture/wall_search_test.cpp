#include "stages/capture/wall_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "stages/capture/coarse_cloud.hpp"
#include "support/world_scene.hpp"

namespace credo {
namespace {

using test::camera_looking_along_y;
using test::WorldScene;

Se3 camera() {
  return camera_looking_along_y(1.2, 0.2);
}

/// What a perfect camera 1.2 m above the floor makes of a scene, told in the world.
std::optional<Plane> wall_of(WorldScene const& scene) {
  std::vector<PlaneSearchPoints> const frames = {
      coarse_cloud(test::shot_of(scene, camera()).frame.cloud_camera).search};
  Plane const floor = transformed(camera().inverse(), Plane{Eigen::Vector3d::UnitZ(), 0.0});
  std::optional<Plane> const wall = find_wall(frames, floor);
  return wall ? std::optional(transformed(camera(), *wall)) : std::nullopt;
}

/// Leaning back by an angle.
WorldScene with_leaning_wall(double lean_rad) {
  WorldScene scene = WorldScene().with_floor();
  Eigen::Vector3d const normal(0.0, -std::cos(lean_rad), std::sin(lean_rad));
  scene.planes.push_back({normal, normal.dot(Eigen::Vector3d(0, 2.5, 0))});
  return scene;
}

TEST(FindWall, IsThePlaneUprightOnTheFloorFacingTheCamera) {
  Plane const wall = wall_of(WorldScene().with_floor().with_wall(2.5)).value();
  EXPECT_NEAR((wall.normal + Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-4);
  EXPECT_NEAR(wall.offset_m, -2.5, 1e-3);
}

TEST(FindWall, StandsUpright) {
  EXPECT_TRUE(wall_of(with_leaning_wall(0.08)));
  EXPECT_FALSE(wall_of(with_leaning_wall(0.15)));
}

TEST(FindWall, HasNextToNothingBehindIt) {
  WorldScene room = WorldScene().with_floor().with_wall(3.0);
  // It shows more than it leaves of the wall; but the wall is seen beside it.
  room.with_box({-0.9, 2.6, 0.0}, {0.9, 2.9, 1.8});
  EXPECT_NEAR(wall_of(room).value().offset_m, -3.0, 1e-3);
  // Without anything behind it nobody can tell.
  room.planes.pop_back();
  EXPECT_NEAR(wall_of(room).value().offset_m, -2.6, 1e-3);
}

TEST(FindWall, IsNeitherSmallNorNarrow) {
  EXPECT_FALSE(wall_of(WorldScene().with_floor()));
  EXPECT_FALSE(wall_of(WorldScene().with_floor().with_box({-0.35, 2.0, 0}, {0.35, 2.3, 0.5})));
  EXPECT_TRUE(wall_of(WorldScene().with_floor().with_box({-0.6, 2.0, 0}, {0.6, 2.3, 1.0})));
  EXPECT_FALSE(wall_of(WorldScene().with_floor().with_box({-0.2, 2.0, 0}, {0.2, 2.3, 1.8})));
}

TEST(FindWall, OfNothingIsNone) {
  EXPECT_FALSE(find_wall(std::vector<PlaneSearchPoints>(), Plane()));
}

}  // namespace
}  // namespace credo
