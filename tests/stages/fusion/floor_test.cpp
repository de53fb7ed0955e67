#include "stages/fusion/floor.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>

#include "core/cloud.hpp"
#include "stages/fusion/scenes.hpp"

namespace credo {
namespace {

using test::floor_patch;
using testing::SizeIs;

/// Patch `number` of a row, each of 11 x 11 points.
FloorObservation patch(int number, float height_m) {
  float const x = 2.0F * static_cast<float>(number);
  return floor_patch({x, 0}, {x + 1, 1}, height_m);
}

TEST(FusedFloor, TakesTheFirstObservationAsItIs) {
  auto const floor = fused_floor(std::nullopt, patch(0, 0.01F), {});
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->normal, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(floor->height_m, 0.01, 1e-6);
  EXPECT_THAT(*floor->points, SizeIs(121));
}

TEST(FusedFloor, IsTheUnionOfWhatWasSeen) {
  auto floor = fused_floor(std::nullopt, patch(0, 0.01F), {});
  auto const before = floor;
  floor = fused_floor(std::move(floor), patch(1, 0.03F), {});
  EXPECT_THAT(*floor->points, SizeIs(242));
  EXPECT_NEAR(floor->height_m, 0.02, 1e-6);
  EXPECT_THAT(*before->points, SizeIs(121));
}

TEST(FusedFloor, SharesItsPointsWhereNothingIsNew) {
  auto const floor = fused_floor(std::nullopt, patch(0, 0.01F), {});
  auto const again = fused_floor(floor, patch(0, 0.01F), {});
  EXPECT_EQ(again->points, floor->points);
  EXPECT_EQ(fused_floor(floor, std::nullopt, {})->points, floor->points);
}

/// The same points, said to lie in a plane that rises by `slope` along x.
FloorObservation told_with_slope(FloorObservation patch, double slope) {
  Eigen::Vector3d const normal = Eigen::Vector3d(-slope, 0, 1).normalized();
  patch.plane_world = {
      normal, normal.dot(patch.points_world[patch.points_world.size() / 2].cast<double>())};
  return patch;
}

double slope_along_x(FloorBelief const& floor) {
  return -floor.normal.x() / floor.normal.z();
}

TEST(FusedFloor, LeansOnObservedNormalsWhereItsPointsLieClose) {
  FloorObservation const spot = floor_patch({0, 0}, {0.1F, 0.1F}, 0.01F);
  auto floor = fused_floor(std::nullopt, told_with_slope(spot, 0.02), {});
  EXPECT_NEAR(slope_along_x(*floor), 0.02, 0.001);
  floor = fused_floor(std::move(floor), told_with_slope(spot, -0.02), {});
  EXPECT_NEAR(slope_along_x(*floor), 0.0, 0.001);
}

TEST(FusedFloor, IsFittedToItsPointsWhereTheyLieFarApart) {
  // Two strips 8 m apart, level with each other, each told 3 degrees wrong: their planes would part
  // by 40 cm on the way.
  auto floor =
      fused_floor(std::nullopt, told_with_slope(floor_patch({0, 0}, {0.2F, 2}, 0), 0.05), {});
  floor =
      fused_floor(std::move(floor), told_with_slope(floor_patch({8, 0}, {8.2F, 2}, 0), 0.05), {});
  EXPECT_LT(std::abs(slope_along_x(*floor)), 0.001);
  EXPECT_NEAR(floor->height_m, 0.0, 1e-6);
  // And two strips told level of which the far one lies 16 cm higher.
  auto ramp = fused_floor(std::nullopt, floor_patch({0, 0}, {0.2F, 2}, 0), {});
  ramp = fused_floor(std::move(ramp), floor_patch({8, 0}, {8.2F, 2}, 0.16F), {});
  EXPECT_NEAR(slope_along_x(*ramp), 0.02, 0.001);
  // Something between them that lies 2 cm higher lifts the floor there, and tilts nothing.
  floor = fused_floor(std::move(floor), floor_patch({3.6F, 0}, {4.6F, 2}, 0.02F), {});
  EXPECT_LT(std::abs(slope_along_x(*floor)), 0.001);
  EXPECT_GT(floor->height_m, 0.01);
}

TEST(FusedFloor, StopsGrowingAtItsBound) {
  FloorFusionConfig config;
  config.max_points = 300;
  std::optional<FloorBelief> floor;
  for (int i = 0; i < 20; ++i) {
    floor = fused_floor(std::move(floor), patch(i, 0.0F), config);
  }
  EXPECT_THAT(*floor->points, SizeIs(300));
}

TEST(FusedFloor, PassesOverWhatIsNoFloor) {
  FloorObservation const good = patch(0, 0.0F);
  FloorObservation no_points = good;
  no_points.points_world = {{kNaN, 0, 0}};
  FloorObservation no_plane = good;
  no_plane.plane_world.offset_m = static_cast<double>(kNaN);
  FloorObservation upright = good;
  upright.plane_world.normal = Eigen::Vector3d::UnitX();
  for (FloorObservation const& bad : {no_points, no_plane, upright}) {
    EXPECT_FALSE(fused_floor(std::nullopt, bad, {}));
    EXPECT_TRUE(fused_floor(fused_floor(std::nullopt, good, {}), bad, {}));
  }
}

}  // namespace
}  // namespace credo
