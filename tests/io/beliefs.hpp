#pragma once

#include <memory>

#include "core/belief.hpp"

namespace credo::test {

/// Points from `first` on by ones, in the order of the file; it moved log-odds by `first` eighths.
inline Account account_from(int first) {
  Account why;
  why.points[PointState::kAgrees] = first;
  why.points[PointState::kOccluded] = first + 1;
  why.points[PointState::kSeenThrough] = first + 2;
  why.points[PointState::kUnmeasured] = first + 3;
  why.points[PointState::kOutOfView] = first + 4;
  why.visible_share = 0.5;
  why.news = 0.25;
  why.moved = -0.125 * first;
  why.bounded = first > 20;
  return why;
}

/// A belief with one of everything, at frame 3; numbers that are short in decimals.
inline BeliefState belief_of_a_kitchen() {
  BeliefState belief;
  belief.frame = FrameIndex{3};
  belief.stamp_ns = 100'000'000;
  belief.segmented_with = FrameIndex{2};
  belief.T_world_camera = Se3(Eigen::Quaterniond::Identity(), {1, 2, 1.5});

  FloorBelief floor;
  floor.height_m = 0.25;
  floor.evidence = Evidence::kOccluded;
  floor.why = account_from(10);
  floor.points = std::make_shared<PointList>(PointList{{1, 2, 0}, {2, 2, 0}});
  belief.floor = floor;

  WallBelief wall;
  wall.id = 4;
  wall.plane_world = {-Eigen::Vector3d::UnitX(), -5.0};
  wall.segment_start_m = {5, -1};
  wall.segment_end_m = {5, 1.5};
  wall.points = std::make_shared<PointList>(PointList{{5, 0, 1}});
  wall.label = LabelCode{2001};
  wall.evidence = Evidence::kOutOfView;
  wall.why = account_from(20);
  belief.walls = {wall};

  ObjectBelief object;
  object.id = "box_1";
  object.type = "box";
  object.pose_world.mean = Se3(Eigen::Quaterniond(0, 0, 0, 1), {2, 0, 0.5});
  object.pose_world.covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  object.evidence = Evidence::kSeenThrough;
  object.why = account_from(30);
  belief.objects = {object};

  auto cluster = std::make_shared<StuffCluster>();
  cluster->pixel_count = 421;
  cluster->centroid_world = {2, 1, 0.5};
  cluster->bounds_world = {Eigen::Vector3f(1.5, 0.5, 0), Eigen::Vector3f(2.5, 1.5, 1)};
  cluster->points_world = {{2, 1, 0.5}};
  StuffBelief stuff;
  stuff.id = 7;
  stuff.history_count = 3;
  stuff.recent_clusters = {cluster};
  stuff.label = LabelCode{4003};
  stuff.why = account_from(40);
  belief.stuff = {stuff};
  return belief;
}

}  // namespace credo::test
