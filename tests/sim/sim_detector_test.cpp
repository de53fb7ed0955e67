#include "sim/sim_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "sim/camera_path.hpp"
#include "sim/scene_time.hpp"
#include "sim/scenes.hpp"
#include "sim/thing.hpp"

namespace credo::test {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A box and two cans before a camera that stands still for long; one can goes after 10 s.
Scene cupboard() {
  Scene scene =
      small_scene({object("box", "box", SceneShape::kBox, {0.4, 0.3, 0.5}, {2, 0, 0.8}),
                   object("can_a", "can", SceneShape::kCylinder, {0.1, 0.3}, {2, 0.6, 0.8}),
                   object("can_b", "can", SceneShape::kCylinder, {0.1, 0.3}, {2, -0.6, 0.8})});
  scene.things[0].rpy_deg = {0, 0, 30};
  scene.camera.frames_per_s = 10;
  scene.camera.path = {{0, {0, 0, 1}, {1, 0, 1}}, {1000, {0, 0, 1}, {1, 0, 1.0001}}};
  scene.events = {{10.0, "can_b", SceneChange::kRemoved, {}, {}, {}}};
  return scene;
}

SimDetectorConfig exact() {
  SimDetectorConfig config;
  config.sigma_position_m = 0;
  config.sigma_rotation_rad = 0;
  return config;
}

std::vector<Detection> asked(SimDetector& detector, std::int64_t index,
                             std::vector<std::string> const& types) {
  Frame frame;
  frame.index = FrameIndex{index};
  std::vector<DetectionRequest> requests;
  for (std::string const& type : types) {
    requests.push_back({type + "_id", type, {}});
  }
  return detector.detect(frame, requests);
}

Se3 true_pose(Scene const& scene, std::size_t thing, std::int64_t index) {
  return camera_pose(scene.camera.path, scene_time_s(scene, FrameIndex{index})).inverse() *
         pose_of(scene.things[thing]);
}

TEST(SimDetector, WithoutNoiseItIsTheTruth) {
  Scene const scene = cupboard();
  SimDetector detector(scene, exact());
  std::vector<Detection> const found = asked(detector, 7, {"box"});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(boxminus(found[0].pose_camera.mean, true_pose(scene, 0, 7)).norm(), 0, 1e-12);
  EXPECT_GT(found[0].visible_fraction, 0.95);
  EXPECT_NEAR(found[0].pose_camera.covariance(0, 0), 1e-12, 1e-18) << "still positive definite";
}

TEST(SimDetector, KnowsTypesAndNotIds) {
  Scene const scene = cupboard();
  SimDetector detector(scene, exact());
  EXPECT_THAT(asked(detector, 0, {"can"}), SizeIs(2));
  EXPECT_THAT(asked(detector, 0, {"can", "can", "box"}), SizeIs(3));
  EXPECT_THAT(asked(detector, 0, {"table"}), IsEmpty());
  EXPECT_THAT(asked(detector, 0, {}), IsEmpty());
  EXPECT_THAT(asked(detector, 100, {"can"}), SizeIs(1)) << "the other has been taken away";
}

TEST(SimDetector, WhatHidesIsNotFound) {
  Scene scene = cupboard();
  scene.things.push_back(thing("curtain", SceneShape::kBox, {0.05, 0.6, 2}, {1, 0, 0}));
  SimDetector detector(scene, exact());
  EXPECT_THAT(asked(detector, 0, {"box"}), IsEmpty());
  scene.camera.path = {{0, {0, 0, 1}, {-1, 0, 1}}};
  SimDetector away(scene, exact());
  EXPECT_THAT(asked(away, 0, {"box", "can"}), IsEmpty());
}

// 2000 draws: means within 4 standard errors, variances within 4 of theirs.
TEST(SimDetector, ErrorsAreWhatTheCovarianceSays) {
  Scene const scene = cupboard();
  SimDetectorConfig config;
  config.sigma_position_m = 0.01;
  config.sigma_rotation_rad = 0.03;
  SimDetector detector(scene, config);
  Vector6d sum = Vector6d::Zero();
  Matrix6d squares = Matrix6d::Zero();
  constexpr int kDraws = 2000;
  Matrix6d told;
  for (int i = 0; i < kDraws; ++i) {
    std::vector<Detection> const found = asked(detector, i, {"box"});
    ASSERT_THAT(found, SizeIs(1));
    Vector6d const error = boxminus(found[0].pose_camera.mean, true_pose(scene, 0, i));
    sum += error;
    squares += error * error.transpose();
    told = found[0].pose_camera.covariance;
  }
  for (Eigen::Index k = 0; k < 6; ++k) {
    double const sigma = k < 3 ? 0.01 : 0.03;
    EXPECT_NEAR(told(k, k), sigma * sigma, 1e-12);
    EXPECT_NEAR(sum[k] / kDraws, 0, 4 * sigma / std::sqrt(kDraws));
    EXPECT_NEAR(squares(k, k) / kDraws, sigma * sigma, 4 * sigma * sigma * std::sqrt(2.0 / kDraws));
  }
  EXPECT_NEAR(squares(0, 4) / kDraws, 0, 4 * 0.01 * 0.03 / std::sqrt(kDraws));
}

TEST(SimDetector, ABiasIsAlongTheWorldsAxes) {
  Scene const scene = cupboard();
  SimDetectorConfig config = exact();
  config.bias_position_m = {0, 0, -0.04};
  SimDetector detector(scene, config);
  Vector6d const error =
      boxminus(asked(detector, 0, {"box"})[0].pose_camera.mean, true_pose(scene, 0, 0));
  EXPECT_NEAR((error.head<3>() - Eigen::Vector3d(0, 0.04, 0)).norm(), 0, 1e-6) << "down is +y";
}

TEST(SimDetector, MissesAsOftenAsTold) {
  Scene const scene = cupboard();
  SimDetectorConfig config;
  config.miss_probability = 0.3;
  SimDetector missing(scene, config);
  config.miss_probability = 0;
  SimDetector sure(scene, config);
  int found = 0;
  constexpr int kFrames = 1000;
  for (int i = 0; i < kFrames; ++i) {
    std::vector<Detection> const some = asked(missing, i, {"box"});
    if (!some.empty()) {
      ++found;
      EXPECT_EQ(some[0].pose_camera.mean.matrix(),
                asked(sure, i, {"box"})[0].pose_camera.mean.matrix());
    }
  }
  EXPECT_NEAR(found, 0.7 * kFrames, 4 * std::sqrt(0.21 * kFrames));
}

TEST(SimDetector, FalseAlarmsLieInView) {
  Scene const scene = cupboard();
  SimDetectorConfig config;
  config.false_alarms_per_frame = 1.5;
  SimDetector detector(scene, config);
  std::size_t alarms = 0;
  constexpr int kFrames = 600;
  for (int i = 0; i < kFrames; ++i) {
    std::vector<Detection> const found = asked(detector, i, {"box"});
    alarms += found.size() - 1;
    for (std::size_t k = 1; k < found.size(); ++k) {
      Eigen::Vector3d const& p = found[k].pose_camera.mean.translation();
      EXPECT_GE(p.z(), 0.5);
      EXPECT_LE(p.z(), 4.0);
      EXPECT_LE(std::abs(60 * p.x() / p.z()), 32.0);
      EXPECT_LE(std::abs(62 * p.y() / p.z()), 24.0);
    }
  }
  EXPECT_NEAR(static_cast<double>(alarms), 1.5 * kFrames, 4 * std::sqrt(1.5 * kFrames));
}

TEST(SimDetector, DependsOnFrameAndSeedOnly) {
  Scene const scene = cupboard();
  SimDetectorConfig config;
  config.false_alarms_per_frame = 1;
  SimDetector forth(scene, config);
  SimDetector back(scene, config);
  config.seed = 2;
  SimDetector other(scene, config);
  std::vector<std::vector<Detection>> first;
  for (int i = 0; i < 20; ++i) {
    first.push_back(asked(forth, i, {"box", "can"}));
  }
  for (int i = 19; i >= 0; i -= 3) {
    std::vector<Detection> const again = asked(back, i, {"box", "can"});
    auto const& before = first[static_cast<std::size_t>(i)];
    ASSERT_EQ(again.size(), before.size());
    for (std::size_t k = 0; k < again.size(); ++k) {
      EXPECT_EQ(again[k].pose_camera.mean.matrix(), before[k].pose_camera.mean.matrix());
    }
    EXPECT_NE(asked(other, i, {"box"})[0].pose_camera.mean.matrix(),
              before[0].pose_camera.mean.matrix());
  }
}

TEST(SimDetector, TakesItsTime) {
  SimDetectorConfig config = exact();
  config.latency_s = 0.05;
  SimDetector detector(cupboard(), config);
  auto const begin = std::chrono::steady_clock::now();
  EXPECT_THAT(asked(detector, 0, {"box"}), SizeIs(1));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(50));
}

}  // namespace
}  // namespace credo::test
