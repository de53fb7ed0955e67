#include "stages/fusion/walls.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/cloud.hpp"
#include "stages/fusion/scenes.hpp"

namespace credo {
namespace {

using test::wall;
using testing::Eq;
using testing::IsEmpty;
using testing::Le;
using testing::SizeIs;

FusedWalls fused(std::vector<std::vector<WallObservation>> const& frames,
                 WallFusionConfig const& config = {}) {
  FusedWalls walls;
  for (auto const& seen : frames) {
    walls = fused_walls(std::move(walls), seen, config);
  }
  return walls;
}

/// Without trimming, so that segments end where the points do.
WallFusionConfig untrimmed() {
  WallFusionConfig config;
  config.segment_trim_ratio = 0.0;
  return config;
}

void expect_segment(WallBelief const& belief, Eigen::Vector2d const& a, Eigen::Vector2d const& b) {
  // Rounding of float coordinates.
  double const tolerance_m = 1e-4;
  Eigen::Vector2d const& start = belief.segment_start_m;
  Eigen::Vector2d const& end = belief.segment_end_m;
  bool const as_given = (start - a).norm() < tolerance_m && (end - b).norm() < tolerance_m;
  bool const reversed = (start - b).norm() < tolerance_m && (end - a).norm() < tolerance_m;
  EXPECT_TRUE(as_given || reversed) << start.transpose() << " to " << end.transpose()
                                    << " instead of " << a.transpose() << " to " << b.transpose();
}

TEST(FusedWalls, BecomeSegmentsOnTheFloor) {
  FusedWalls const walls = fused({{wall(2000, {1, 2}, {4, 6}), wall(2001, {0, 0}, {2, 0})}});
  ASSERT_THAT(walls.walls, SizeIs(2));
  EXPECT_EQ(walls.walls[0].id, 1U);
  EXPECT_EQ(walls.walls[0].label, LabelCode{2000});
  EXPECT_EQ(walls.walls[1].id, 2U);
  EXPECT_EQ(walls.next_id, 3U);
  expect_segment(walls.walls[0], {1, 2}, {4, 6});
  expect_segment(walls.walls[1], {0, 0}, {2, 0});
}

TEST(FusedWalls, ExtendTheSegmentOfAWallSeenAgain) {
  FusedWalls const walls = fused({{wall(2003, {0, 1}, {3, 1})}, {wall(2000, {2, 1}, {4, 1})}});
  ASSERT_THAT(walls.walls, SizeIs(1));
  expect_segment(walls.walls[0], {0, 1}, {4, 1});
  EXPECT_EQ(walls.walls[0].label, LabelCode{2000});
  // 31 + 10 columns of 21 points, on a grid of half their spacing.
  EXPECT_THAT(*walls.walls[0].points, SizeIs(41 * 21));
}

TEST(FusedWalls, NeedTheOverlapThatTheConfigAsksFor) {
  // 1 m of 2.4 m is more than 0.4; 0.9 m is less.
  EXPECT_THAT(fused({{wall(2000, {0, 0}, {3, 0})}, {wall(2000, {2, 0}, {4.4, 0})}}).walls,
              SizeIs(1));
  EXPECT_THAT(fused({{wall(2000, {0, 0}, {3, 0})}, {wall(2000, {2.1, 0}, {4.5, 0})}}).walls,
              SizeIs(2));
}

TEST(FusedWalls, AreDifferentBesideEachOtherOrAtAnAngle) {
  EXPECT_THAT(fused({{wall(2000, {0, 0}, {3, 0})}, {wall(2000, {0, 0.04}, {3, 0.04})}}).walls,
              SizeIs(1));
  EXPECT_THAT(fused({{wall(2000, {0, 0}, {3, 0})}, {wall(2000, {0, 0.06}, {3, 0.06})}}).walls,
              SizeIs(2));
  EXPECT_THAT(fused({{wall(2000, {0, 0}, {3, 0})}, {wall(2000, {0, -0.2}, {3, 0.2})}}).walls,
              SizeIs(2));
}

TEST(FusedWalls, CompareOffsetsAtTheWallAndNotAtTheOrigin) {
  // Seen again with a normal 0.03 rad off, 10 m from the origin along the wall: at the wall's
  // middle the planes meet, at the origin they are 0.3 m apart.
  WallObservation tilted = wall(2000, {9, 1}, {11, 1});
  double const tilt_rad = 0.03;
  tilted.plane_world.normal = so3_exp({0, 0, tilt_rad}) * tilted.plane_world.normal;
  tilted.plane_world.offset_m = tilted.plane_world.normal.dot(Eigen::Vector3d(10, 1, 1));
  FusedWalls const walls = fused({{wall(2000, {9, 1}, {11, 1})}, {tilted}});
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_NEAR(walls.walls[0].plane_world.signed_distance_m({10, 1, 1}), 0.0, 1e-6);
}

TEST(FusedWalls, AlignTheNormalOfAWallSeenFromBehind) {
  FusedWalls const walls =
      fused({{wall(2000, {0, 1}, {3, 1})}, {wall(2000, {3, 1.02}, {0, 1.02})}});
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_TRUE(walls.walls[0].plane_world.normal.isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(walls.walls[0].plane_world.offset_m, 1.01, 1e-6);
}

TEST(FusedWalls, WeighPlanesByPixels) {
  WallObservation heavy = wall(2000, {0, 1}, {3, 1});
  heavy.pixel_count = 3000;
  WallObservation light = wall(2000, {0, 1.04}, {3, 1.04});
  light.pixel_count = 1000;
  FusedWalls const walls = fused({{heavy}, {light}});
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_NEAR(walls.walls[0].plane_world.offset_m, 1.01, 1e-6);
  EXPECT_NEAR(walls.walls[0].plane_world.normal.norm(), 1.0, 1e-12);
  EXPECT_EQ(walls.walls[0].weight_pixels, 4000.0);
}

/// A piece of the wall y = 1, seen from 2 m before its middle; the plane laid through it leans, but
/// its points do not.
WallObservation leaning_piece(double from_m, double to_m, double slope) {
  WallObservation piece = wall(2000, {from_m, 1}, {to_m, 1});
  Eigen::Vector3d const normal = Eigen::Vector3d(slope, -1, 0).normalized();
  piece.plane_world = {normal, normal.dot(Eigen::Vector3d(0.5 * (from_m + to_m), 1, 0))};
  return piece;
}

// A look at a short piece errs in its turn, which the mean of planes carries to the wall's ends.
TEST(FusedWalls, AreFittedToAllThatWasSeenOfThem) {
  FusedWalls fitted;
  FusedWalls averaged;
  for (int i = 0; i < 4; ++i) {
    WallObservation const piece = leaning_piece(i, i + 2, 0.02);
    Eigen::Vector3d const camera(i + 1, -1, 0.5);
    fitted = fused_walls(std::move(fitted), {piece}, {}, camera);
    averaged = fused_walls(std::move(averaged), {piece}, {});
  }
  ASSERT_THAT(fitted.walls, SizeIs(1));
  ASSERT_THAT(averaged.walls, SizeIs(1));
  Eigen::Vector3d const end(5, 1, 0);
  EXPECT_NEAR(fitted.walls[0].plane_world.signed_distance_m(end), 0.0, 0.005);
  EXPECT_GT(std::abs(averaged.walls[0].plane_world.signed_distance_m(end)), 0.03);
  EXPECT_LT(fitted.walls[0].plane_world.normal.y(), 0.0) << "it faces as it did";
}

// First from 5 m, where depth is off by 4 cm, then from 2 m.
TEST(FusedWalls, AreFittedByTheNoiseOfWhatWasSeen) {
  FusedWalls walls;
  walls = fused_walls(std::move(walls), {wall(2000, {0, 1.04}, {3, 1.04})}, {},
                      Eigen::Vector3d(1.5, -4, 0.5));
  walls = fused_walls(std::move(walls), {wall(2000, {0, 1}, {3, 1})}, {},
                      Eigen::Vector3d(1.5, -1, 0.5));
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_NEAR(walls.walls[0].plane_world.signed_distance_m({1.5, 1, 0.5}), 0.0, 0.004);
}

TEST(FusedWalls, GiveAnObservationToTheLongestOverlap) {
  WallFusionConfig config;
  config.merge_known = false;
  FusedWalls const walls = fused({{wall(2000, {0, 0}, {1.5, 0}), wall(2001, {1.6, 0}, {5, 0})},
                                  {wall(2000, {0.5, 0}, {4, 0})}},
                                 config);
  ASSERT_THAT(walls.walls, SizeIs(2));
  EXPECT_THAT(walls.walls[0].label, Eq(std::nullopt));
  EXPECT_EQ(walls.walls[1].label, LabelCode{2000});
  expect_segment(walls.walls[1], {0.5, 0}, {5, 0});
}

TEST(FusedWalls, GiveATieToTheLowerId) {
  WallFusionConfig config;
  config.merge_known = false;
  FusedWalls const walls = fused(
      {{wall(2000, {0, 0}, {2, 0}), wall(2001, {4, 0}, {6, 0})}, {wall(2000, {1, 0}, {5, 0})}},
      config);
  ASSERT_THAT(walls.walls, SizeIs(2));
  EXPECT_EQ(walls.walls[0].label, LabelCode{2000});
  EXPECT_THAT(walls.walls[1].label, Eq(std::nullopt));
}

TEST(FusedWalls, MergeWhereAnObservationJoinsThem) {
  std::vector<std::vector<WallObservation>> const frames = {
      {wall(2000, {0, 0}, {1.5, 0}), wall(2001, {1.6, 0}, {5, 0})}, {wall(2000, {0.5, 0}, {4, 0})}};
  FusedWalls const walls = fused(frames);
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_EQ(walls.walls[0].id, 1U);
  EXPECT_EQ(walls.walls[0].label, LabelCode{2000});
  EXPECT_EQ(walls.next_id, 3U);
  expect_segment(walls.walls[0], {0, 0}, {5, 0});
}

TEST(FusedWalls, MergeOnUntilNoneMatches) {
  // A look at the first wall brings the third within the offset; that one, of far more pixels,
  // brings the plane of both to where the second is within it too.
  WallObservation first = wall(2000, {0, 0}, {6, 0});
  WallObservation second = wall(2001, {0, 0.09}, {2, 0.09});
  WallObservation third = wall(2002, {3, 0.06}, {6, 0.06});
  WallObservation again = wall(2000, {0, 0.04}, {6, 0.04});
  first.pixel_count = again.pixel_count = 1000;
  second.pixel_count = 1000;
  third.pixel_count = 10000;
  EXPECT_THAT(fused({{first, second, third}}).walls, SizeIs(3));
  FusedWalls const walls = fused({{first, second, third}, {again}});
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_EQ(walls.walls[0].weight_pixels, 13000.0);
}

TEST(FusedWalls, TakeTwoPlanesInOneWallAsOne) {
  FusedWalls const walls =
      fused({{wall(2000, {0, 0}, {3, 0}), wall(2001, {0.5, 0.03}, {2, 0.03})}});
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_EQ(walls.walls[0].label, LabelCode{2000});
}

TEST(FusedWalls, ForgetTheLabelWhereTheFrameDoesNotShowThem) {
  FusedWalls const walls = fused({{wall(2000, {0, 0}, {3, 0})}, {}});
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_THAT(walls.walls[0].label, Eq(std::nullopt));
}

TEST(FusedWalls, AreNotStretchedByAStrayPoint) {
  WallObservation seen = wall(2000, {0, 0}, {3, 0});
  seen.points_world.emplace_back(7.0F, 0.0F, 1.0F);
  expect_segment(fused({{seen}}).walls.at(0), {0, 0}, {3, 0});
  expect_segment(fused({{seen}}, untrimmed()).walls.at(0), {0, 0}, {7, 0});
}

TEST(FusedWalls, LeanOverTheirSegment) {
  // Leaning by 0.05: the plane of the wall meets z = 0 at y = 1, its points at mid height stand at
  // y = 1.05, and the segment, swept upward, goes through their middle.
  WallObservation leaning = wall(2000, {0, 1}, {3, 1});
  for (Eigen::Vector3f& p : leaning.points_world) {
    p.y() += 0.05F * p.z();
  }
  leaning.plane_world.normal = Eigen::Vector3d(0, 1, -0.05).normalized();
  leaning.plane_world.offset_m = leaning.plane_world.normal.y();
  expect_segment(fused({{leaning}}).walls.at(0), {0, 1.05}, {3, 1.05});
}

TEST(FusedWalls, MatchASinglePointWithinTheSegment) {
  WallObservation inside = wall(2000, {0, 0}, {3, 0});
  inside.points_world = {{1, 0, 1}};
  WallObservation outside = inside;
  outside.points_world = {{4, 0, 1}};
  EXPECT_THAT(fused({{inside}}).walls, SizeIs(1));
  EXPECT_THAT(fused({{wall(2000, {0, 0}, {3, 0})}, {inside}}).walls, SizeIs(1));
  EXPECT_THAT(fused({{wall(2000, {0, 0}, {3, 0})}, {outside}}).walls, SizeIs(2));
}

TEST(FusedWalls, StayWithinTheirBoundOfPoints) {
  WallFusionConfig config;
  config.max_points = 100;
  FusedWalls walls;
  for (int i = 0; i < 30; ++i) {
    walls = fused_walls(std::move(walls), {wall(2000, {0.1 * i, 0}, {0.1 * i + 3, 0})}, config);
  }
  ASSERT_THAT(walls.walls, SizeIs(1));
  EXPECT_THAT(*walls.walls[0].points, SizeIs(Le(100U)));
  expect_segment(walls.walls[0], {0, 0}, {5.9, 0});
}

TEST(FusedWalls, PassOverWhatIsNoWall) {
  WallObservation no_points = wall(2000, {0, 0}, {3, 0});
  no_points.points_world = {{kNaN, kNaN, kNaN}};
  WallObservation no_plane = wall(2000, {0, 0}, {3, 0});
  no_plane.plane_world.normal.x() = static_cast<double>(kNaN);
  WallObservation level = wall(2000, {0, 0}, {3, 0});
  level.plane_world = {};
  EXPECT_THAT(fused({{no_points, no_plane, level}, {}}).walls, IsEmpty());
}

}  // namespace
}  // namespace credo
