#include "sim/camera_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace credo::test {
namespace {

using Eigen::Vector3d;

std::vector<SceneWaypoint> const kPath = {
    {1, {0, 0, 1}, {2, 0, 0.5}}, {2, {0, 1, 1.5}, {2, 1, 0.5}}, {4, {1, 1, 1}, {3, 0, 0}}};

Vector3d vector_of(std::vector<double> const& v) {
  return {v[0], v[1], v[2]};
}

TEST(CameraPath, PassesThroughItsWaypointsAndLooksAtTheirAims) {
  for (SceneWaypoint const& waypoint : kPath) {
    Se3 const T = camera_pose(kPath, waypoint.time_s);
    EXPECT_NEAR((T.translation() - vector_of(waypoint.position_m)).norm(), 0, 1e-12);
    Vector3d const aim_camera = T.inverse() * vector_of(waypoint.look_at_m);
    EXPECT_NEAR(aim_camera.head<2>().norm(), 0, 1e-12);
    EXPECT_GT(aim_camera.z(), 1.0);
  }
}

TEST(CameraPath, IsUpright) {
  for (double t = 1.0; t <= 4.0; t += 0.125) {
    Eigen::Matrix3d const R = camera_pose(kPath, t).rotation().toRotationMatrix();
    EXPECT_NEAR(R(2, 0), 0, 1e-12) << "the picture's rows are level";
    EXPECT_LT(R(2, 1), 0) << "down in the picture is down in the world";
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
  }
}

TEST(CameraPath, RestsBeforeAndAfter) {
  auto const expect_same = [](Se3 const& a, Se3 const& b) {
    EXPECT_NEAR((a.matrix() - b.matrix()).norm(), 0, 1e-12);
  };
  expect_same(camera_pose(kPath, -5), camera_pose(kPath, 1));
  expect_same(camera_pose(kPath, 9), camera_pose(kPath, 4));
  std::vector<SceneWaypoint> const one = {kPath[1]};
  expect_same(camera_pose(one, 0), camera_pose(one, 100));
}

TEST(CameraPath, HasNoJumpInPlaceOrSpeed) {
  constexpr double kStepS = 1e-3;
  Vector3d last = camera_pose(kPath, 1).translation();
  Vector3d last_step = Vector3d::Zero();
  for (double t = 1.0 + kStepS; t < 4.0; t += kStepS) {
    Vector3d const now = camera_pose(kPath, t).translation();
    Vector3d const step = now - last;
    EXPECT_LT(step.norm(), 3.0 * kStepS) << t;
    EXPECT_LT((step - last_step).norm(), 20.0 * kStepS * kStepS) << t;
    last = now;
    last_step = step;
  }
}

TEST(CameraPath, MayLookStraightDown) {
  std::vector<SceneWaypoint> const down = {{0, {1, 2, 3}, {1, 2, 0}}};
  Eigen::Matrix3d const R = camera_pose(down, 0).rotation().toRotationMatrix();
  EXPECT_NEAR((R.col(2) - Vector3d(0, 0, -1)).norm(), 0, 1e-12);
  EXPECT_NEAR((R.col(1) - Vector3d(-1, 0, 0)).norm(), 0, 1e-12) << "x of the world is up";
}

}  // namespace
}  // namespace credo::test
