#include "stages/capture/floor_lean.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "stages/capture/calibration_rooms.hpp"
#include "stages/capture/floor_search.hpp"
#include "stages/capture/level.hpp"

namespace credo {
namespace {

using test::TruePose;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A frame of the furnished room, in a source frame that lies so in the world.
FramePtr frame_of(TruePose const& pose, SensorModel sensor, Se3 const& T_source_world,
                  int seed = 1) {
  Scene const scene = test::furnished_room();
  SceneCaster caster(scene);
  RenderedView const view = caster.at(0.0).render(pose.T_world_camera());
  Frame frame;
  frame.intrinsics = {scene.camera.fx_px, scene.camera.fy_px, scene.camera.cx_px,
                      scene.camera.cy_px};
  frame.cloud_camera =
      cloud_from_depth(measured_depth(view, scene, sensor, seed, FrameIndex{0}), frame.intrinsics);
  frame.T_source_camera = T_source_world * pose.T_world_camera();
  return std::make_shared<Frame const>(std::move(frame));
}

/// The source is turned about the world's x, so that the floor rises along its y, and lifted.
Se3 leaning(double lean_rad, double height_m = 0.0) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(lean_rad, Eigen::Vector3d::UnitX())),
          {0.0, 0.0, height_m}};
}

FloorLean lean_of(Frame const& frame) {
  CoarseCloud const coarse = coarse_cloud(frame.cloud_camera);
  return floor_lean(find_floor(coarse).value(), coarse, frame.T_source_camera);
}

TEST(FloorLean, IsToldOfATurnedAndLiftedSource) {
  FloorLean const lean = lean_of(*frame_of({}, SensorModel::kIdeal, leaning(3.0 * kDegree, 0.5)));
  EXPECT_NEAR(lean.slope.x(), 0.0, 1e-3);
  EXPECT_NEAR(lean.slope.y(), std::tan(3.0 * kDegree), 1e-3);
  EXPECT_NEAR(lean.lean_rad(), 3.0 * kDegree, 1e-3);
  // Half a metre at x = y = 0, more where the floor is seen, about 1.5 to 2.8 m along y.
  EXPECT_GT(lean.height_m, 0.5 + 1.0 * std::tan(3.0 * kDegree));
  EXPECT_LT(lean.height_m, 0.5 + 2.8 * std::tan(3.0 * kDegree));
  EXPECT_FALSE(lean.may_be_level());
  EXPECT_FALSE(lean.may_be_at_zero());
}

TEST(FloorLean, AnUprightFloorIsNotLevel) {
  // A source like the camera: y down.
  TruePose const pose;
  FloorLean const lean =
      lean_of(*frame_of(pose, SensorModel::kIdeal, pose.T_world_camera().inverse()));
  EXPECT_FALSE(lean.may_be_level());
}

// Not wrong by more than is told, however the camera is turned; nor so vague that it says nothing.
TEST(FloorLean, IsAsWrongAsIsTold) {
  double slopes = 0.0;
  double heights = 0.0;
  int count = 0;
  for (SensorModel const sensor : {SensorModel::kDisparity, SensorModel::kGaussian}) {
    for (double const pitch_deg : {15.0, 25.0, 40.0}) {
      for (double const roll_deg : {-6.0, 0.0, 10.0}) {
        TruePose const pose{pitch_deg * kDegree, roll_deg * kDegree, 1.3, 0.3};
        FloorLean const lean = lean_of(*frame_of(pose, sensor, {}, count));
        EXPECT_TRUE(lean.may_be_level()) << pitch_deg << ' ' << roll_deg;
        EXPECT_LT(std::sqrt(lean.slope_covariance.trace()), 0.5 * kDegree);
        EXPECT_LT(lean.height_deviation_m, 0.004);
        slopes += lean.slope.dot(lean.slope_covariance.inverse() * lean.slope);
        heights += std::pow(lean.height_m / lean.height_deviation_m, 2);
        ++count;
      }
    }
  }
  EXPECT_LT(slopes / count, 2.0);
  EXPECT_LT(heights / count, 1.0);
}

TEST(FloorLean, ALevelSourceIsNotTurnedByASensorsSteps) {
  for (int seed = 0; seed < 4; ++seed) {
    FramePtr const frame = frame_of({}, SensorModel::kDisparity, {}, seed);
    WorldLevel const level = find_level({&frame, 1}, {});
    EXPECT_TRUE(level.floor_found);
    EXPECT_EQ(level.T_world_source.matrix(), Eigen::Matrix4d::Identity()) << level.note;
    EXPECT_THAT(level.note, testing::HasSubstr("source taken as level"));
    PoseConfig by_floor;
    by_floor.level = LevelMode::kByFloor;
    EXPECT_NE(find_level({&frame, 1}, by_floor).T_world_source.matrix(),
              Eigen::Matrix4d::Identity());
  }
}

TEST(FloorLean, ALevelSourceAtAnotherHeightIsLiftedAlone) {
  FramePtr const frame = frame_of({}, SensorModel::kDisparity, leaning(0.0, 0.7));
  WorldLevel const level = find_level({&frame, 1}, {});
  EXPECT_EQ(level.T_world_source.rotation().coeffs(), Eigen::Quaterniond::Identity().coeffs());
  EXPECT_NEAR(level.T_world_source.translation().z(), -0.7, 0.005);
}

TEST(FloorLean, ASourceThatLeansIsLevelled) {
  Se3 const T_source_world = leaning(1.0 * kDegree);
  FramePtr const frame = frame_of({}, SensorModel::kDisparity, T_source_world);
  Se3 const T_level_world = find_level({&frame, 1}, {}).T_world_source * T_source_world;
  Eigen::Vector3d const up = T_level_world.rotation() * Eigen::Vector3d::UnitZ();
  EXPECT_LT(std::acos(up.z()), 0.3 * kDegree);
}

}  // namespace
}  // namespace credo
