#include "stages/capture/level.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "support/world_scene.hpp"

namespace credo {
namespace {

using test::camera_looking_along_y;
using test::shot_of;
using test::WorldScene;

/// What a camera sees whose poses count in a source frame of any kind.
FramePtr frame_in_source(WorldScene const& scene, Se3 const& T_world_camera,
                         Se3 const& T_source_world) {
  Frame frame = shot_of(scene, T_world_camera).frame;
  frame.T_source_camera = T_source_world * T_world_camera;
  return std::make_shared<Frame const>(std::move(frame));
}

WorldScene room() {
  return WorldScene().with_floor().with_wall(3.0).with_box({0.3, 1.5, 0.0}, {0.8, 2.0, 0.5});
}

TEST(Level, TurnsTheFloorToZeroByTheLeastRotation) {
  // A source frame like the first camera's: y down, z forward.
  Se3 const T_world_camera = camera_looking_along_y(1.3, 0.5);
  Se3 const T_source_world = T_world_camera.inverse();
  FramePtr const frame = frame_in_source(room(), T_world_camera, T_source_world);
  WorldLevel const level = find_level({&frame, 1}, {});
  EXPECT_TRUE(level.floor_found);
  EXPECT_THAT(level.note, testing::HasSubstr("levelled by the floor in frame 0, 1.30 m below"));
  Se3 const T_level_world = level.T_world_source * T_source_world;
  // Up is up and the floor is z = 0; yaw, x and y are the source's, so a turn about z remains.
  EXPECT_LT((T_level_world.rotation() * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm(),
            0.01);
  EXPECT_NEAR(T_level_world.translation().z(), 0.0, 0.01);
  // The least rotation turns about an axis across both ups, so nothing about either of them.
  Eigen::Vector3d const up_source = T_source_world.rotation() * Eigen::Vector3d::UnitZ();
  Eigen::Vector3d const turn = so3_log(level.T_world_source.rotation());
  EXPECT_NEAR(turn.normalized().dot(up_source), 0.0, 0.01);
  EXPECT_NEAR(turn.normalized().z(), 0.0, 0.01);
  // Shifted along z only.
  EXPECT_NEAR(level.T_world_source.translation().x(), 0.0, 1e-12);
  EXPECT_NEAR(level.T_world_source.translation().y(), 0.0, 1e-12);
}

TEST(Level, LooksAtLaterFramesWhereTheFirstShowNoFloor) {
  Se3 const up = camera_looking_along_y(1.3, -0.3);
  Se3 const down = camera_looking_along_y(1.3, 0.5);
  std::vector<FramePtr> const frames = {frame_in_source(WorldScene().with_wall(3.0), up, {}),
                                        frame_in_source(room(), down, {})};
  WorldLevel const level = find_level(frames, {});
  EXPECT_TRUE(level.floor_found);
  EXPECT_LT(level.T_world_source.translation().norm(), 0.01);
}

TEST(Level, FallsBackOnTheConfiguredCamera) {
  Se3 const T_world_camera = camera_looking_along_y(0.9, 0.4);
  FramePtr const frame =
      frame_in_source(WorldScene().with_wall(2.0), T_world_camera, T_world_camera.inverse());
  PoseConfig config;
  config.camera_pitch_rad = 0.4;
  config.camera_height_m = 0.9;
  WorldLevel const level = find_level({&frame, 1}, config);
  EXPECT_FALSE(level.floor_found);
  EXPECT_THAT(level.note, testing::HasSubstr("no floor in view"));
  // The camera is the source: up (z of the world) comes out as z, 0.9 m beneath it is z = 0.
  Eigen::Vector3d const up_camera = T_world_camera.rotation().inverse() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((level.T_world_source.rotation() * up_camera - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(level.T_world_source.translation().z(), 0.9, 1e-12);
}

TEST(Level, RollsToTheRight) {
  PoseConfig config;
  config.camera_roll_rad = 0.2;
  Se3 const T_world_camera = camera_looking_along_y(1.0, 0.0);
  FramePtr const frame =
      frame_in_source(WorldScene().with_wall(2.0), T_world_camera, T_world_camera.inverse());
  WorldLevel const level = find_level({&frame, 1}, config);
  ASSERT_FALSE(level.floor_found);
  // A camera that leans to its right has its x axis pointing down: right of the picture is lower.
  EXPECT_LT((level.T_world_source.rotation() * Eigen::Vector3d::UnitX()).z(), -0.19);
}

TEST(Level, OffTakesTheSourceAsItIs) {
  FramePtr const frame = frame_in_source(room(), camera_looking_along_y(1.3, 0.5), {});
  PoseConfig config;
  config.level = LevelMode::kOff;
  WorldLevel const level = find_level({&frame, 1}, config);
  EXPECT_TRUE(level.floor_found);
  EXPECT_EQ(level.T_world_source.matrix(), Eigen::Matrix4d::Identity());
}

TEST(Level, IsTakenAsGivenWhateverIsInView) {
  // A floor half a metre lower and level is in view.
  Se3 const T_world_camera = camera_looking_along_y(1.8, 0.5);
  Se3 const T_source_camera = camera_looking_along_y(0.3, -0.2);
  FramePtr const frame =
      frame_in_source(room(), T_world_camera, T_source_camera * T_world_camera.inverse());
  PoseConfig config;
  config.level = LevelMode::kGiven;
  config.camera_pitch_rad = 0.4;
  config.camera_height_m = 1.3;
  config.camera_x_m = 2.0;
  config.camera_y_m = -1.0;
  WorldLevel const level = find_level({&frame, 1}, config);
  EXPECT_TRUE(level.floor_found);
  EXPECT_TRUE(level.given);
  EXPECT_THAT(level.note, testing::HasSubstr("stands as given: 1.30 m up, pitch 0.40 rad"));
  Se3 const expected =
      Se3(Eigen::Quaterniond::Identity(), {2.0, -1.0, 0.0}) * camera_looking_along_y(1.3, 0.4);
  Se3 const camera = level.T_world_source * T_source_camera;
  EXPECT_LT((camera.matrix() - expected.matrix()).norm(), 1e-12);
  EXPECT_FALSE(find_level({&frame, 1}, {}).given);
}

TEST(Level, GivenYawTurnsCounterclockwiseSeenFromAbove) {
  PoseConfig config;
  config.level = LevelMode::kGiven;
  config.camera_yaw_rad = 0.5 * std::numbers::pi;
  Se3 const camera = find_level({}, config).T_world_source;
  // From +y to -x.
  EXPECT_LT((camera.rotation() * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitX()).norm(),
            1e-12);
  EXPECT_LT((camera.translation() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(Level, WithoutAnyFrameStandsUpright) {
  WorldLevel const level = find_level({}, {});
  EXPECT_FALSE(level.floor_found);
  EXPECT_NEAR(level.T_world_source.translation().z(), 1.0, 1e-12);
}

}  // namespace
}  // namespace credo
