#include "stages/fusion/moved_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "stages/fusion/drift/drift_room.hpp"

namespace credo {
namespace {

Se3 motion() {
  Vector6d error;
  error << 0.3, -0.2, 0.1, 0.05, -0.1, 0.4;
  return boxplus(Se3{}, error);
}

Segmentation some_frame() {
  Se3 const camera = test::looking_into_the_corner();
  Segmentation frame = test::frame_of({.crates = test::crates(3)}, camera, camera);
  for (StuffCluster& cluster : frame.stuff) {
    for (Eigen::Vector3f const& point : cluster.points_world) {
      cluster.bounds_world.extend(point);
    }
    cluster.centroid_world = cluster.bounds_world.center();
  }
  PoseDistribution pose{camera, Matrix6d::Zero()};
  pose.covariance.diagonal() << 1, 4, 9, 16, 25, 36;
  frame.objects.emplace_back().pose_world = pose;
  frame.refused.emplace_back().pose_world = pose;
  return frame;
}

void expect_moved(PointList const& after, PointList const& before) {
  ASSERT_EQ(after.size(), before.size());
  ASSERT_FALSE(before.empty());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT((after[i].cast<double>() - motion() * before[i].cast<double>()).norm(), 1e-6);
  }
}

void expect_moved(Plane const& after, Plane const& before) {
  for (Eigen::Vector3d const& p : {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-2, 0, 1)}) {
    EXPECT_NEAR(after.signed_distance_m(motion() * p), before.signed_distance_m(p), 1e-12);
  }
}

void expect_moved(PoseDistribution const& after, PoseDistribution const& before) {
  EXPECT_LT((after.mean.matrix() - (motion() * before.mean).matrix()).norm(), 1e-12);
  Matrix6d turned = before.covariance;
  Eigen::Matrix3d const R = motion().rotation().toRotationMatrix();
  turned.topLeftCorner<3, 3>() = R * turned.topLeftCorner<3, 3>() * R.transpose();
  turned.bottomRightCorner<3, 3>() = R * turned.bottomRightCorner<3, 3>() * R.transpose();
  EXPECT_LT((after.covariance - turned).norm(), 1e-12);
}

TEST(MovedSegmentation, MovesAllThatIsInTheWorld) {
  Segmentation before = some_frame();
  before.T_world_told = motion();
  Segmentation const after = moved(before, motion());
  EXPECT_LT((after.T_world_camera.matrix() - (motion() * before.T_world_camera).matrix()).norm(),
            1e-12);
  EXPECT_LT((after.T_world_told.matrix() - (motion() * motion()).matrix()).norm(), 1e-12);
  expect_moved(after.floor->plane_world, before.floor->plane_world);
  expect_moved(after.floor->points_world, before.floor->points_world);
  ASSERT_EQ(after.walls.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    expect_moved(after.walls[i].plane_world, before.walls[i].plane_world);
    expect_moved(after.walls[i].points_world, before.walls[i].points_world);
  }
  expect_moved(after.objects[0].pose_world, before.objects[0].pose_world);
  expect_moved(after.refused[0].pose_world, before.refused[0].pose_world);
  ASSERT_EQ(after.stuff.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_moved(after.stuff[i].points_world, before.stuff[i].points_world);
    expect_moved(PointList{after.stuff[i].centroid_world}, {before.stuff[i].centroid_world});
    Eigen::AlignedBox3f slack = after.stuff[i].bounds_world;
    slack.extend(Eigen::Vector3f(slack.min().array() - 1e-5F));
    slack.extend(Eigen::Vector3f(slack.max().array() + 1e-5F));
    for (Eigen::Vector3f const& point : after.stuff[i].points_world) {
      EXPECT_TRUE(slack.contains(point));
    }
    EXPECT_LT(after.stuff[i].bounds_world.diagonal().norm(),
              1.8F * before.stuff[i].bounds_world.diagonal().norm());
  }
}

TEST(MovedSegmentation, LeavesWhatIsInTheImage) {
  Segmentation const before = some_frame();
  Segmentation const after = moved(before, motion());
  EXPECT_TRUE(std::equal(after.labels.begin(), after.labels.end(), before.labels.begin()));
  EXPECT_TRUE(std::equal(after.sight.depth_m.begin(), after.sight.depth_m.end(),
                         before.sight.depth_m.begin()));
}

TEST(MovedSegmentation, NothingIsMovedToNothing) {
  Segmentation const after = moved(Segmentation{}, motion());
  EXPECT_FALSE(after.floor);
  EXPECT_TRUE(after.stuff.empty());
  Segmentation empty_box;
  empty_box.stuff.emplace_back();
  EXPECT_TRUE(moved(empty_box, motion()).stuff[0].bounds_world.isEmpty());
}

}  // namespace
}  // namespace credo
