#include "stages/fusion/floor.hpp"

#include <gmock/gmock.h>

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

TEST(FusedFloor, WeighsNormalsByPoints) {
  FloorObservation tilted = floor_patch({0, 0}, {1, 1}, 0.01F);
  tilted.plane_world.normal = Eigen::Vector3d(0.02, 0, 1).normalized();
  tilted.plane_world.offset_m = tilted.plane_world.normal.dot(Eigen::Vector3d(0.52, 0.52, 0.01));
  auto floor = fused_floor(std::nullopt, floor_patch({0, 0}, {1, 3.2F}, 0.01F), {});
  ASSERT_THAT(*floor->points, SizeIs(11 * 33));
  floor = fused_floor(std::move(floor), tilted, {});
  EXPECT_NEAR(floor->normal.x() / floor->normal.z(), 0.02 / 4, 1e-5);
  // Both planes pass through the same height at x = 0.52, where the centroid is.
  EXPECT_NEAR(floor->height_m, 0.01, 1e-5);
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
