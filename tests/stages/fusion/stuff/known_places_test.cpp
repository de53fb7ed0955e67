#include "stages/fusion/stuff/known_places.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "stages/fusion/stuff/table_views.hpp"

namespace credo {
namespace {

/// A wall along x at y = 2, from x = 0 to 3; the camera stands at the origin.
BeliefState with_wall() {
  BeliefState belief;
  WallBelief& wall = belief.walls.emplace_back();
  wall.plane_world = {-Eigen::Vector3d::UnitY(), -2.0};
  wall.segment_start_m = {0, 2};
  wall.segment_end_m = {3, 2};
  wall.log_odds = 1.0;
  return belief;
}

TEST(KnownPlaces, WallsGoOnALittleBeyondTheirEnds) {
  KnownPlaces const places(with_wall(), {});
  EXPECT_TRUE(places.has_wall_at({1, 2, 0.5}));
  EXPECT_TRUE(places.has_wall_at({-0.05, 2, 0.5}));
  EXPECT_TRUE(places.has_wall_at({3.05, 2, 0.5}));
  EXPECT_FALSE(places.has_wall_at({-0.15, 2, 0.5}));
  EXPECT_FALSE(places.has_wall_at({3.15, 2, 0.5}));
  EXPECT_FALSE(places.has_object_at({1, 2, 0.5}));
}

// Each point within 2.1 cm, and the mean of those that are within 1.7 cm before it.
TEST(KnownPlaces, WhatIsOnAWallDoesNotStandBeforeItOnTheMean) {
  auto const are_on_walls = [](BeliefState const& belief, std::vector<float> const& before_m) {
    std::vector<Eigen::Vector3f> points;
    for (float const off_m : before_m) {
      points.emplace_back(0.1F, 2.0F - off_m, 0.0F);
    }
    return KnownPlaces(belief, {}).are_on_walls(points, 0.6);
  };
  EXPECT_TRUE(are_on_walls(with_wall(), {0.0F, 0.0F, 0.1F}));
  EXPECT_FALSE(are_on_walls(with_wall(), {0.0F, 0.1F})) << "too few";
  EXPECT_TRUE(are_on_walls(with_wall(), {0.019F, 0.013F}));
  EXPECT_FALSE(are_on_walls(with_wall(), {0.019F, 0.018F}));
  EXPECT_TRUE(are_on_walls(with_wall(), {-0.019F, -0.018F})) << "behind it";
  EXPECT_FALSE(are_on_walls({}, {0.0F}));
  EXPECT_FALSE(are_on_walls(with_wall(), {}));
}

// 1.5 cm + 1.5 mm at one metre, 2.1 cm at two.
TEST(KnownPlaces, ToleranceGrowsAsNoiseDoes) {
  KnownPlaces const places(with_wall(), {});
  EXPECT_TRUE(places.has_wall_at({0, 2.020, 0}));
  EXPECT_FALSE(places.has_wall_at({0, 2.023, 0}));
  EXPECT_FALSE(places.has_wall_at({0, 1.977, 0}));
  EXPECT_TRUE(places.has_wall_at({3, 1.966, 0})) << "3.6 m away";
}

TEST(KnownPlaces, OnlyBelievedWallsCount) {
  BeliefState belief = with_wall();
  belief.walls[0].log_odds = -0.1;
  EXPECT_FALSE(KnownPlaces(belief, {}).has_wall_at({1, 2, 0.5}));
  belief = with_wall();
  belief.walls[0].segment_end_m = belief.walls[0].segment_start_m;
  EXPECT_FALSE(KnownPlaces(belief, {}).has_wall_at({0, 2, 0.5})) << "without length";
}

// A centimetre high at x = 0; the camera stands 1 m above that, and looks at it from there.
TEST(KnownPlaces, TheFloorIsWhatIsUpTo5MmAboveItAndNotFarBelow) {
  BeliefState belief;
  belief.T_world_camera = Se3(Eigen::Quaterniond::Identity(), {0, 0, 1.01});
  FloorBelief& floor = belief.floor.emplace();
  floor.normal = Eigen::Vector3d(-0.1, 0, 1).normalized();
  floor.height_m = 0.11;
  floor.points = std::make_shared<PointList const>(PointList{{1, 0, 0.11F}});
  floor.log_odds = 1.0;
  KnownPlaces const places(belief, {});
  EXPECT_TRUE(places.has_floor_at({0, 0, 0.014}));
  EXPECT_FALSE(places.has_floor_at({0, 0, 0.016}));
  EXPECT_TRUE(places.has_floor_at({1, 0, 0.11}));
  EXPECT_TRUE(places.has_floor_at({0, 0, -0.005}));
  EXPECT_FALSE(places.has_floor_at({0, 0, -0.01})) << "below the floor is another room";
  EXPECT_EQ(places.share_known(std::vector<Eigen::Vector3f>{{0, 0, 0.01F}, {0, 0, 0.2F}}, false),
            0.5);
  belief.floor->log_odds = -0.1;
  EXPECT_FALSE(KnownPlaces(belief, {}).has_floor_at({0, 0, 0.01})) << "not believed";
  EXPECT_FALSE(KnownPlaces({}, {}).has_floor_at({0, 0, 0})) << "none";
}

KnownSurfaces const& surfaces() {
  static KnownSurfaces const known = known_surfaces(
      {{"box", {"box", std::vector<Solid>{BoxSolid{{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.1}}}, {}}}});
  return known;
}

/// A box that the last frame did not find, its front 1 m from the camera.
BeliefState with_box(double sigma_m) {
  BeliefState belief;
  ObjectBelief& object = belief.objects.emplace_back();
  object.type = "box";
  object.log_odds = 1.0;
  object.pose_world.mean = Se3(Eigen::Quaterniond::Identity(), {1.1, 0, 0});
  object.pose_world.covariance = Matrix6d::Identity() * sigma_m * sigma_m;
  return belief;
}

TEST(KnownPlaces, ObjectsAreTheirSurface) {
  KnownPlaces const places(with_box(1e-4), surfaces());
  EXPECT_TRUE(places.has_object_at({1.0, 0, 0.05}));
  EXPECT_TRUE(places.has_object_at({0.985, 0, 0.05}));
  EXPECT_FALSE(places.has_object_at({0.975, 0, 0.05}));
  EXPECT_FALSE(places.has_object_at({1.1, 0, 0.05})) << "deep inside";
  EXPECT_FALSE(places.has_object_at({5, 0, 0.05}));
}

TEST(KnownPlaces, WhatMayBeOffATheirPlaceIsAllowedFor) {
  EXPECT_TRUE(KnownPlaces(with_box(0.01), surfaces()).has_object_at({0.97, 0, 0.05}));
  EXPECT_FALSE(KnownPlaces(with_box(0.05), surfaces()).has_object_at({1.0, 0, 0.05}))
      << "where it is, is not known";
}

TEST(KnownPlaces, FoundOrDisbelievedObjectsExplainNothing) {
  BeliefState belief = with_box(1e-4);
  belief.objects[0].evidence = Evidence::kSeen;
  EXPECT_TRUE(KnownPlaces(belief, surfaces()).has_object_at({1.0, 0, 0.05}))
      << "it has moved there: nothing of it has been taken out of the frame";
  belief.objects[0].label = kFirstObject;
  EXPECT_FALSE(KnownPlaces(belief, surfaces()).has_object_at({1.0, 0, 0.05}));
  belief = with_box(1e-4);
  belief.objects[0].log_odds = -1.0;
  EXPECT_FALSE(KnownPlaces(belief, surfaces()).has_object_at({1.0, 0, 0.05}));
  EXPECT_FALSE(KnownPlaces(with_box(1e-4), {}).has_object_at({1.0, 0, 0.05})) << "no model";
}

// Two centimetres, as the pose is known to one.
TEST(KnownPlaces, WhatAPoseThatIsNotQuiteRightLeavesBehindIsBesideTheObject) {
  auto const share_at = [](BeliefState const& belief, std::vector<Eigen::Vector3f> const& points) {
    return KnownPlaces(belief, surfaces()).share_left_behind(points);
  };
  BeliefState belief = with_box(0.01);
  EXPECT_EQ(share_at(belief, {{0.99F, 0, 0.05F}}), 0.0) << "the frame does not show the box";
  belief.objects[0].label = kFirstObject;
  EXPECT_EQ(share_at(belief, {{0.99F, 0, 0.05F}, {0.981F, 0, 0.05F}, {1.01F, 0, 0.05F}}), 1.0);
  EXPECT_EQ(share_at(belief, {{0.99F, 0, 0.05F}, {0.975F, 0, 0.05F}}), 0.5) << "too far off";
  EXPECT_EQ(share_at(belief, {{1.1F, 0, 0.105F}}), 0.0) << "may lie on it";
  EXPECT_EQ(share_at(belief, {{5, 0, 0.05F}}), 0.0);
  EXPECT_EQ(share_at(belief, {}), 0.0);
  // On its side: what faced up does not, and a side does.
  belief.objects[0].pose_world.mean =
      Se3(Eigen::Quaterniond(Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitY())),
          {1.1, 0, 0});
  EXPECT_EQ(share_at(belief, {{0.99F, 0, 0.05F}}), 1.0);
  EXPECT_EQ(share_at(belief, {{1.05F, 0, 0.105F}}), 0.0);
  belief = with_box(0.001);
  belief.objects[0].label = kFirstObject;
  EXPECT_EQ(share_at(belief, {{0.99F, 0, 0.05F}}), 0.0) << "its place is well known";
}

// A pillar: how it is turned about its axis nobody can tell, and it does not matter.
TEST(KnownPlaces, TurnsThatDoNotShowNeedNotBeKnown) {
  BeliefState belief = with_box(1e-4);
  belief.objects[0].pose_world.covariance(5, 5) = 1.0;
  ObjectModel pillar{"box", std::vector<Solid>{CylinderSolid{0.1, 0.1}}, {}};
  Eigen::Vector3d const front(1.0, 0, 0.05);
  EXPECT_FALSE(KnownPlaces(belief, known_surfaces({{"box", pillar}})).has_object_at(front));
  pillar.symmetry.axis.emplace();
  EXPECT_TRUE(KnownPlaces(belief, known_surfaces({{"box", pillar}})).has_object_at(front));
}

TEST(KnownPlaces, WhatStandsWhereAnObjectIsFoundElsewhereMayBeThat) {
  BeliefState belief = with_box(1e-4);
  std::vector<Eigen::Vector3f> points = {{1, 0.5F, 0.05F}, {1, 0.52F, 0.05F}, {1, 0.54F, 0.05F}};
  double const whatever = std::numeric_limits<double>::infinity();
  EXPECT_EQ(KnownPlaces(belief, surfaces()).most_log_odds_at(points), whatever);
  belief.objects[0].other_place = OtherPlace{belief.objects[0].pose_world, 0.7, {}};
  EXPECT_EQ(KnownPlaces(belief, surfaces()).most_log_odds_at(points), whatever) << "beside it";
  belief.objects[0].other_place->pose_world.mean =
      Se3(Eigen::Quaterniond::Identity(), {1.1, 0.5, 0});
  EXPECT_EQ(KnownPlaces(belief, surfaces()).most_log_odds_at(points), -0.7);
  points.emplace_back(0.8F, 0.5F, 0.05F);
  EXPECT_EQ(KnownPlaces(belief, surfaces()).most_log_odds_at(points), -0.7) << "three of four";
  points.emplace_back(0.8F, 0.5F, 0.05F);
  EXPECT_EQ(KnownPlaces(belief, surfaces()).most_log_odds_at(points), whatever) << "three of five";
}

std::vector<Eigen::Vector3f> square_at(double z_m) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 100; ++i) {
    points.emplace_back(0.02F * static_cast<float>(i % 10), 0.02F * static_cast<float>(i / 10),
                        static_cast<float>(z_m));
  }
  return points;
}

/// The last frame had a board of 20 cm at 1.5 m, before a wall at 3 m.
BeliefState after_a_frame(test::View const& view) {
  Segmentation const frame = test::segmentation_of(view);
  BeliefState belief;
  belief.last_sight =
      std::make_shared<PlacedSight const>(PlacedSight{frame.sight, frame.T_world_camera});
  return belief;
}

TEST(KnownPlaces, WhatStandsWhereOneSawThroughHasArrived) {
  BeliefState const belief = after_a_frame({.boards = {{kFirstStuff}}});
  KnownPlaces const places(belief, {});
  EXPECT_EQ(places.share_free_before(square_at(1.5)), 0.0) << "it stood there";
  EXPECT_EQ(places.share_free_before(square_at(1.3)), 1.0) << "before the board all was free";
  EXPECT_EQ(places.share_free_before(square_at(1.7)), 0.0) << "behind it nobody knows";
  EXPECT_EQ(places.share_free_before({}), 0.0);
  EXPECT_EQ(KnownPlaces({}, {}).share_free_before(square_at(1.3)), 0.0) << "no frame before";
}

TEST(KnownPlaces, OfAFewPointsNothingIsTold) {
  BeliefState const belief = after_a_frame({.boards = {{kFirstStuff}}});
  std::vector<Eigen::Vector3f> points = square_at(1.3);
  points.resize(8);
  EXPECT_EQ(KnownPlaces(belief, {}).share_free_before(points), 1.0);
  points.resize(7);
  EXPECT_EQ(KnownPlaces(belief, {}).share_free_before(points), 0.0);
}

TEST(KnownPlaces, ShareOfPointsThatAreKnown) {
  KnownPlaces const places(with_wall(), {});
  std::vector<Eigen::Vector3f> const points = {{1, 2, 0}, {1, 2, 1}, {1, 1, 0}, {1, 0, 0}};
  EXPECT_EQ(places.share_known(points, true), 0.5);
  EXPECT_EQ(places.share_known(points, false), 0.5);
  EXPECT_EQ(places.share_known({}, true), 0.0);
  BeliefState const box = with_box(1e-4);
  KnownPlaces const object(box, surfaces());
  std::vector<Eigen::Vector3f> const front = {{1, 0, 0.05F}};
  EXPECT_EQ(object.share_known(front, true), 1.0);
  EXPECT_EQ(object.share_known(front, false), 0.0) << "it lies on something";
}

}  // namespace
}  // namespace credo
