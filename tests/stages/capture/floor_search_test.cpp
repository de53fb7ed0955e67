#include "stages/capture/floor_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/world_scene.hpp"

namespace credo {
namespace {

using test::camera_looking_along_y;
using test::Shot;
using test::shot_of;
using test::WorldScene;

std::optional<Plane> floor_in(Shot const& shot) {
  return find_floor(shot.frame.cloud_camera);
}

/// The floor told in the world where it should be z = 0.
void expect_is_floor(Shot const& shot, std::optional<Plane> const& found_camera) {
  ASSERT_TRUE(found_camera);
  Plane const world = transformed(shot.T_world_camera, *found_camera);
  EXPECT_GT(world.normal.z(), std::cos(0.01));
  EXPECT_NEAR(world.offset_m, 0.0, 0.01);
}

TEST(FloorSearch, TakesTheFloorThoughATableIsLarger) {
  Shot const shot = shot_of(WorldScene().with_floor().with_box({-0.9, 0.3, 0.68}, {0.9, 1.3, 0.72}),
                            camera_looking_along_y(1.4, 0.75));
  expect_is_floor(shot, floor_in(shot));
}

TEST(FloorSearch, FindsItFromTiltedAndRolledCameras) {
  WorldScene const room =
      WorldScene().with_floor().with_wall(3.0).with_box({0.3, 1.5, 0.0}, {0.8, 2.0, 0.5});
  for (double const pitch_rad : {0.3, 0.6, 0.9}) {
    for (double const roll_rad : {-0.3, 0.0, 0.3}) {
      Se3 const roll(so3_exp({0.0, 0.0, roll_rad}), {0.0, 0.0, 0.0});
      Shot const shot = shot_of(room, camera_looking_along_y(1.2, pitch_rad) * roll);
      expect_is_floor(shot, floor_in(shot));
    }
  }
}

TEST(FloorSearch, TakesNoTableTopThatStandsFree) {
  // The table alone: a drop all around it, into nothing that the camera sees.
  Shot const shot = shot_of(WorldScene().with_box({-0.6, 0.7, 0.68}, {0.6, 1.5, 0.72}),
                            camera_looking_along_y(1.4, 0.7));
  EXPECT_FALSE(floor_in(shot));
}

TEST(FloorSearch, TakesNoTableWithThingsOnIt) {
  Shot const shot = shot_of(WorldScene()
                                .with_box({-0.6, 0.7, 0.68}, {0.6, 1.5, 0.72})
                                .with_box({-0.1, 1.0, 0.72}, {0.1, 1.1, 0.9}),
                            camera_looking_along_y(1.4, 0.7));
  EXPECT_FALSE(floor_in(shot));
}

TEST(FloorSearch, TakesNoWallAndNoCeiling) {
  EXPECT_FALSE(floor_in(shot_of(WorldScene().with_wall(2.0), camera_looking_along_y(1.2, 0.0))));
  WorldScene ceiling;
  ceiling.planes.push_back({-Eigen::Vector3d::UnitZ(), -2.5});
  EXPECT_FALSE(floor_in(shot_of(ceiling, camera_looking_along_y(1.2, -0.6))));
}

TEST(FloorSearch, FindsNothingInEmptyPictures) {
  for (auto const& [width, height] : {std::pair{0, 0}, {1, 1}, {64, 48}}) {
    EXPECT_FALSE(find_floor(OrganizedCloud(width, height)));
  }
}

}  // namespace
}  // namespace credo
