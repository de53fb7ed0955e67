#include "sim/pose_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace credo::test {
namespace {

Se3 some_pose() {
  return {so3_exp({0.3, -0.2, 1.1}), {1, 2, 1.5}};
}

TEST(PoseError, NoneWhereTheSceneHasNone) {
  Se3 const told = told_pose({}, some_pose(), 100.0, 1, FrameIndex{3});
  EXPECT_EQ(told.matrix(), some_pose().matrix());
}

TEST(PoseError, DriftGrowsWithTime) {
  SceneCamera camera;
  camera.pose_drift_m_per_s = 0.01;
  camera.pose_drift_rad_per_s = 0.002;
  for (double const since_s : {0.0, 10.0, 60.0}) {
    Vector6d const error =
        boxminus(told_pose(camera, some_pose(), since_s, 1, FrameIndex{0}), some_pose());
    EXPECT_NEAR(error.head<3>().norm(), 0.01 * since_s, 1e-12);
    EXPECT_NEAR(error[5], 0.002 * since_s, 1e-12);
  }
}

TEST(PoseError, JitterIsAsWideAsTold) {
  SceneCamera camera;
  camera.pose_jitter_m = 0.01;
  camera.pose_jitter_rad = 0.005;
  Vector6d squares = Vector6d::Zero();
  constexpr int kFrames = 2000;
  for (int i = 0; i < kFrames; ++i) {
    Se3 const told = told_pose(camera, some_pose(), 0.0, 1, FrameIndex{i});
    squares += boxminus(told, some_pose()).cwiseAbs2();
  }
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(std::sqrt(squares[k] / kFrames), k < 3 ? 0.01 : 0.005, k < 3 ? 0.0007 : 0.00035);
  }
}

TEST(PoseError, TheSameForTheSameSeedAndFrame) {
  SceneCamera camera;
  camera.pose_jitter_m = 0.01;
  auto const told = [&](int seed, std::int64_t frame) {
    return told_pose(camera, some_pose(), 0.0, seed, FrameIndex{frame}).matrix();
  };
  EXPECT_EQ(told(1, 2), told(1, 2));
  EXPECT_NE(told(1, 2), told(2, 2));
  EXPECT_NE(told(1, 2), told(1, 3));
}

}  // namespace
}  // namespace credo::test
