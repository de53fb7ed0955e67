#include "stages/fusion/known_places.hpp"

#include <gtest/gtest.h>

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
  EXPECT_FALSE(KnownPlaces(belief, surfaces()).has_object_at({1.0, 0, 0.05}));
  belief = with_box(1e-4);
  belief.objects[0].log_odds = -1.0;
  EXPECT_FALSE(KnownPlaces(belief, surfaces()).has_object_at({1.0, 0, 0.05}));
  EXPECT_FALSE(KnownPlaces(with_box(1e-4), {}).has_object_at({1.0, 0, 0.05})) << "no model";
}

}  // namespace
}  // namespace credo
