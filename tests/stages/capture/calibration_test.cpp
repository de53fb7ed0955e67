#include "stages/capture/calibration.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "stages/capture/calibration_rooms.hpp"
#include "stages/capture/level.hpp"

namespace credo::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double turn_between_deg(Se3 const& a, Se3 const& b) {
  return so3_log(a.rotation().inverse() * b.rotation()).norm() / kDegree;
}

std::vector<TruePose> still(TruePose const& pose, int frames = 4) {
  std::vector<TruePose> poses(static_cast<std::size_t>(frames), pose);
  return poses;
}

Calibration calibrated(Scene const& scene, std::vector<TruePose> const& poses, SensorModel sensor,
                       bool with_wall) {
  return calibrate(looks_at(scene, poses, sensor), with_wall).calibration.value();
}

/// The world that the wall across +y makes: x away from it, the camera at y = 0.
Se3 in_wall_world(Se3 const& T_world_camera) {
  Eigen::AngleAxisd const turn(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ());
  Eigen::Vector3d const camera = turn * T_world_camera.translation();
  return Se3(Eigen::Quaterniond(turn), {kWallY_m, -camera.y(), 0.0}) * T_world_camera;
}

struct Sensor {
  std::string name;
  SensorModel model;
  /// What the noise of a sensor leaves, and what is wrong with the rest: pixels of things at the
  /// foot of the wall that pass for the floor, a share of a percent.
  double most_deg;
  double most_m;
};

class Poses : public ::testing::TestWithParam<std::tuple<TruePose, Sensor>> {};

TEST_P(Poses, AreFoundByFloorAndWall) {
  auto const& [pose, sensor] = GetParam();
  Calibration const found =
      calibrated(furnished_room(), still(pose), sensor.model, /*with_wall=*/true);
  EXPECT_NEAR(found.camera.pitch_rad / kDegree, pose.pitch_rad / kDegree, sensor.most_deg);
  EXPECT_NEAR(found.camera.roll_rad / kDegree, pose.roll_rad / kDegree, sensor.most_deg);
  EXPECT_NEAR(found.camera.height_m, pose.height_m, sensor.most_m);
  EXPECT_NEAR(found.camera.x_m, kWallY_m, sensor.most_m);
  EXPECT_EQ(found.camera.y_m, 0.0);
  Se3 const camera = given_camera(given_pose(found.camera));
  Se3 const truth = in_wall_world(pose.T_world_camera());
  EXPECT_LT(turn_between_deg(camera, truth), 1.5 * sensor.most_deg);
  EXPECT_LT((camera.translation() - truth.translation()).norm(), 1.5 * sensor.most_m);
  EXPECT_LT(std::abs(found.wall_lean_rad) / kDegree, 3.0 * sensor.most_deg);
  ASSERT_TRUE(found.spread);
  EXPECT_LT(found.spread->height_m, sensor.most_m);
  EXPECT_LT(found.spread->yaw_rad / kDegree, sensor.most_deg);
}

INSTANTIATE_TEST_SUITE_P(
    Calibration, Poses,
    ::testing::Combine(::testing::Values(TruePose{0.4, 0.0, 1.2, 0.0}, TruePose{0.5, 0.2, 1.5, 0.3},
                                         TruePose{0.35, -0.3, 0.8, -0.2},
                                         TruePose{0.7, 0.05, 2.1, 0.1}),
                       ::testing::Values(Sensor{"ideal", SensorModel::kIdeal, 0.02, 0.0005},
                                         Sensor{"gaussian", SensorModel::kGaussian, 0.1, 0.003},
                                         Sensor{"disparity", SensorModel::kDisparity, 0.1, 0.003})),
    [](auto const& instance) {
      return std::get<1>(instance.param).name + std::to_string(instance.index / 3);
    });

TEST(Calibrate, WithoutAWallIsTheLevelOfTheFloor) {
  TruePose const pose{0.5, 0.2, 1.5, 0.3};
  Calibration const found =
      calibrated(furnished_room(), still(pose, 1), SensorModel::kIdeal, false);
  EXPECT_FALSE(found.wall);
  EXPECT_EQ(found.camera.yaw_rad, 0.0);
  EXPECT_EQ(found.camera.x_m, 0.0);
  EXPECT_FALSE(found.spread) << "one frame";
  Frame frame;
  SceneCaster caster(furnished_room());
  frame.cloud_camera = cloud_from_depth(caster.at(0.0).render(pose.T_world_camera()).depth_m, {});
  auto const shared = std::make_shared<Frame const>(std::move(frame));
  WorldLevel const level = find_level({{shared}}, {});
  ASSERT_TRUE(level.floor_found);
  // The level is one frame's plain fit.
  Se3 const camera = given_camera(given_pose(found.camera));
  EXPECT_LT(turn_between_deg(camera, level.T_world_source), 0.1);
  EXPECT_LT((camera.translation() - level.T_world_source.translation()).norm(), 0.003);
}

TEST(Calibrate, TellsHowFramesDiffer) {
  std::vector<TruePose> poses;
  for (double const rise_m : {-0.01, 0.01, -0.01, 0.01, 0.0}) {
    poses.push_back({0.4 + rise_m, 0.1, 1.2 + rise_m, 0.0});
  }
  Calibration const found = calibrated(furnished_room(), poses, SensorModel::kIdeal, true);
  // Four deviations of 1 cm, and of 0.01 rad, among five. The gate of the joint fit cuts some away.
  EXPECT_NEAR(found.spread.value().height_m, 0.01, 0.001);
  EXPECT_NEAR(found.spread->pitch_rad, 0.01, 0.001);
  EXPECT_LT(found.spread->roll_rad, 0.001);
  EXPECT_NEAR(found.camera.height_m, 1.2, 0.002);
}

TEST(Calibrate, LeavesOutFramesThatSeeTheFloorElsewhere) {
  std::vector<TruePose> poses = still({}, 5);
  poses[1].height_m += 0.1;
  poses[3].pitch_rad += 0.08;
  CalibrationResult const result =
      calibrate(looks_at(furnished_room(), poses, SensorModel::kIdeal), false);
  EXPECT_EQ(result.frames_with_floor, 5);
  EXPECT_EQ(result.frames_agreeing, 3);
  EXPECT_NEAR(result.calibration.value().camera.height_m, TruePose{}.height_m, 0.0005);
  EXPECT_EQ(result.calibration->floor.frame_count, 3);
}

TEST(Calibrate, WantsTheFloorInHalfOfTheFrames) {
  std::vector<TruePose> poses = still({}, 4);
  poses[0].pitch_rad = poses[1].pitch_rad = -0.3;
  EXPECT_TRUE(calibrate(looks_at(furnished_room(), poses, SensorModel::kIdeal), false).calibration);
  poses[2].pitch_rad = -0.3;
  CalibrationResult const result =
      calibrate(looks_at(furnished_room(), poses, SensorModel::kIdeal), false);
  EXPECT_FALSE(result.calibration);
  EXPECT_EQ(result.fault, CalibrationFault::kNoFloor);
  EXPECT_EQ(result.frames_with_floor, 1);
  EXPECT_FALSE(calibrate({}, false).calibration);
}

TEST(Calibrate, RefusesACameraThatMoves) {
  std::vector<TruePose> poses;
  for (int i = 0; i < 6; ++i) {
    poses.push_back({0.4, 0.0, 1.0 + 0.05 * i, 0.0});
  }
  CalibrationResult const result =
      calibrate(looks_at(furnished_room(), poses, SensorModel::kIdeal), false);
  EXPECT_FALSE(result.calibration);
  EXPECT_EQ(result.fault, CalibrationFault::kFloorMoves);
  EXPECT_EQ(result.frames_agreeing, 1);
}

TEST(Calibrate, WithoutAWallInViewThereIsNone) {
  Scene const yard = scene_of({floor_thing(), block("parcel", {0.3, 0.3, 0.25}, {0.4, 1.7, 0})});
  CalibrationResult const result = calibrate(looks_at(yard, still({}), SensorModel::kIdeal), true);
  EXPECT_FALSE(result.calibration);
  EXPECT_EQ(result.fault, CalibrationFault::kNoWall);
  EXPECT_TRUE(calibrate(looks_at(yard, still({}), SensorModel::kIdeal), false).calibration);
}

TEST(Calibrate, TheFrontOfACabinetIsNoWall) {
  // It shows more than twice the wall's pixels.
  Scene const room =
      scene_of({floor_thing(), wall_thing(), block("cabinet", {1.3, 0.5, 1.5}, {-0.2, 1.75, 0})});
  Calibration const found =
      calibrated(room, still({0.25, 0.0, 1.2, 0.0}), SensorModel::kDisparity, true);
  EXPECT_NEAR(found.camera.x_m, kWallY_m, 0.01);
}

TEST(Calibrate, PointsAtTheLargerOfTwoWalls) {
  // Turned so far that the wall to the right fills the view.
  Calibration const found =
      calibrated(furnished_room(), still({0.3, 0.0, 1.2, -1.2}), SensorModel::kDisparity, true);
  EXPECT_NEAR(found.camera.x_m, 2.55, 0.01);
}

TEST(SurfacesIn, AreFloorAndWallOfAFrame) {
  TruePose const pose;
  Scene const room = furnished_room();
  Calibration const found = calibrated(room, still(pose), SensorModel::kDisparity, true);
  SceneCaster caster(room);
  RenderedView const view = caster.at(0.0).render(pose.T_world_camera());
  LabelMap const labels = surfaces_in(
      cloud_from_depth(measured_depth(view, room, SensorModel::kDisparity, 1, FrameIndex{0}), {}),
      found);
  std::vector<int> floor(room.things.size(), 0);
  std::vector<int> wall(room.things.size(), 0);
  std::vector<int> all(room.things.size(), 0);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != kNoDepth) {
      auto const thing = static_cast<std::size_t>(view.thing[i]);
      ++all[thing];
      floor[thing] += labels[i] == kFloor ? 1 : 0;
      wall[thing] += labels[i] == kFirstWall ? 1 : 0;
    }
  }
  // Three standard deviations hold nearly all of it, and little of what stands on it.
  EXPECT_GT(floor[0], 0.95 * all[0]);
  EXPECT_GT(wall[1], 0.95 * all[1]);
  for (std::size_t thing : {3, 4}) {
    EXPECT_LT(floor[thing] + wall[thing], 0.1 * all[thing]) << room.things[thing].name;
  }
}

}  // namespace
}  // namespace credo::test
