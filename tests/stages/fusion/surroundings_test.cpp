#include "stages/fusion/surroundings.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "stages/fusion/fusion.hpp"
#include "stages/fusion/stuff/table_views.hpp"

namespace credo::test {
namespace {

constexpr LabelCode kWall = kFirstWall;
constexpr std::int64_t kTenth_ns = 100'000'000;

/// World x ahead, y to the left, z up.
Se3 level_camera() {
  Eigen::Matrix3d R_world_camera;
  R_world_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {Eigen::Quaterniond(R_world_camera), Eigen::Vector3d::Zero()};
}

/// From a camera that looks ahead. It may call a board of 80 x 80 cm, 1.5 m away, a wall.
Segmentation frame_of(int number, std::vector<Board> boards, bool shows_wall) {
  Segmentation frame =
      segmentation_of({.boards = std::move(boards), .stamp_ns = number * kTenth_ns});
  frame.frame = FrameIndex{number};
  frame.T_world_camera = level_camera();
  if (shows_wall) {
    WallObservation& wall = frame.walls.emplace_back();
    wall.label = kWall;
    wall.plane_world = {-Eigen::Vector3d::UnitX(), -1.5};
    wall.pixel_count = 6400;
    for (int i = 0; i < 1600; ++i) {
      Eigen::Vector3d const p_camera(0.02 * (i % 40), 0.02 * (i / 40) - 0.4, 1.5);
      wall.points_world.push_back((frame.T_world_camera * p_camera).cast<float>());
    }
  }
  return frame;
}

/// From one that looks down.
Segmentation frame_from_above(int number, std::vector<Board> boards) {
  Segmentation frame = frame_of(number, std::move(boards), false);
  frame.T_world_camera = Se3();
  return frame;
}

Board board() {
  return {kWall, 0.0, -0.4, 0.8, 0.8, 1.5};
}

BeliefState with_wall() {
  BeliefState belief = fuse({}, frame_of(0, {board()}, true), {});
  return fuse(std::move(belief), frame_of(1, {board()}, true), {});
}

TEST(Walls, BeginAsNewThingsDoAndGainBySight) {
  BeliefState belief = fuse({}, frame_of(0, {board()}, true), {});
  ASSERT_EQ(belief.walls.size(), 1U);
  EXPECT_NEAR(probability_of(belief.walls[0].log_odds), FusionConfig{}.new_probability, 1e-12);
  belief = fuse(std::move(belief), frame_of(1, {board()}, true), {});
  EXPECT_GT(probability_of(belief.walls[0].log_odds), FusionConfig{}.new_probability);
  EXPECT_EQ(belief.walls[0].evidence, Evidence::kSeen);
  EXPECT_GT(belief.walls[0].why.moved, 0.0);
  EXPECT_GT(belief.walls[0].why.points[PointState::kAgrees], 200);
}

TEST(Walls, GainWhereTheFrameDoesNotCallThemWalls) {
  BeliefState belief = with_wall();
  double const before = belief.walls[0].log_odds;
  belief =
      fuse(std::move(belief), frame_of(2, {{kFirstStuff, 0.0, -0.4, 0.8, 0.8, 1.5}}, false), {});
  EXPECT_GT(belief.walls[0].log_odds, before);
  EXPECT_FALSE(belief.walls[0].label.has_value());
  EXPECT_TRUE(belief.stuff.empty()) << "what is on a believed wall is nothing new";
}

TEST(NewThings, ThatCameWhereNothingStoodMayGoAgain) {
  std::vector<Board> const thing = {{kFirstStuff, 0.0, -0.4, 0.8, 0.8, 1.5}};
  BeliefState const at_first = fuse({}, frame_of(0, thing, false), {});
  EXPECT_GT(probability_of(at_first.stuff.at(0).log_odds), 0.95);
  BeliefState belief = fuse({}, frame_of(0, {}, false), {});
  belief = fuse(std::move(belief), frame_of(1, thing, false), {});
  EXPECT_NEAR(probability_of(belief.stuff.at(0).log_odds), BirthConfig{}.arrived_probability,
              1e-12);
}

TEST(Walls, ThatAreHiddenStayToTheBit) {
  BeliefState belief = with_wall();
  double const before = belief.walls[0].log_odds;
  for (int i = 2; i < 50; ++i) {
    belief = fuse(std::move(belief),
                  frame_of(i, {{std::nullopt, -0.8, -0.6, 1.6, 1.2, 0.8}}, false), {});
    EXPECT_EQ(belief.walls.at(0).evidence, Evidence::kOccluded);
  }
  EXPECT_EQ(belief.walls[0].log_odds, before);
}

TEST(Walls, ThatAreSeenThroughAreNone) {
  BeliefState belief = with_wall();
  for (int i = 2; i < 40; ++i) {
    belief = fuse(std::move(belief), frame_of(i, {board()}, true), {});
  }
  belief = fuse(std::move(belief), frame_of(40, {}, false), {});
  ASSERT_EQ(belief.walls.size(), 1U);
  EXPECT_EQ(belief.walls[0].evidence, Evidence::kSeenThrough);
  for (int i = 41; i < 60; ++i) {
    belief = fuse(std::move(belief), frame_of(i, {}, false), {});
  }
  EXPECT_TRUE(belief.walls.empty());
}

// A pose that has drifted does not take a wall away that the frame shows.
TEST(Walls, ThatAreShownAreNotSeenThrough) {
  BeliefState belief = with_wall();
  double const before = belief.walls[0].log_odds;
  belief = fuse(std::move(belief), frame_of(2, {}, true), {});
  EXPECT_GE(belief.walls.at(0).log_odds, before);
}

TEST(Walls, WithTheThesisRuleStay) {
  FusionConfig config;
  config.visibility = false;
  BeliefState belief = fuse({}, frame_of(0, {board()}, true), config);
  double const before = belief.walls.at(0).log_odds;
  EXPECT_NEAR(probability_of(before), config.prior_probability, 1e-12);
  for (int i = 1; i < 20; ++i) {
    belief = fuse(std::move(belief), frame_of(i, {}, false), config);
  }
  EXPECT_EQ(belief.walls.at(0).log_odds, before);
}

/// The floor of a robot that looks straight down: it is the far wall of the hand-made frames.
BeliefState with_floor(double height_m) {
  BeliefState belief;
  FloorBelief floor;
  floor.height_m = height_m;
  PointList points;
  for (int i = 0; i < 900; ++i) {
    points.emplace_back(0.05F * static_cast<float>(i % 30) - 0.75F,
                        0.05F * static_cast<float>(i / 30) - 0.75F, static_cast<float>(height_m));
  }
  floor.points = std::make_shared<PointList const>(points);
  floor.most_agreeing = 900;
  floor.log_odds = 2.0;
  belief.floor = floor;
  return belief;
}

TEST(Floor, GainsBySight) {
  BeliefState const belief = fuse(with_floor(3.0), frame_from_above(5, {}), {});
  ASSERT_TRUE(belief.floor.has_value());
  EXPECT_GT(belief.floor->log_odds, 2.0);
  EXPECT_EQ(belief.floor->evidence, Evidence::kSeen);
}

TEST(Floor, ThatIsSeenThroughIsNone) {
  BeliefState belief = with_floor(2.0);
  for (int i = 0; i < 20; ++i) {
    belief = fuse(std::move(belief), frame_from_above(i, {}), {});
  }
  EXPECT_FALSE(belief.floor.has_value());
}

TEST(Floor, ThatIsHiddenStaysToTheBit) {
  BeliefState belief = with_floor(3.0);
  for (int i = 0; i < 20; ++i) {
    belief = fuse(std::move(belief), frame_from_above(i, {{std::nullopt, -2, -2, 4, 4, 1.0}}), {});
  }
  ASSERT_TRUE(belief.floor.has_value());
  EXPECT_EQ(belief.floor->log_odds, 2.0);
  EXPECT_EQ(belief.floor->evidence, Evidence::kOccluded);
}

TEST(LookAround, OfManyPointsSomeAreLookedAt) {
  BeliefState belief = with_floor(3.0);
  PointList many = *belief.floor->points;
  for (int i = 0; i < 5; ++i) {
    many.insert(many.end(), belief.floor->points->begin(), belief.floor->points->end());
  }
  belief.floor->points = std::make_shared<PointList const>(many);
  auto const look = look_around(belief.floor, {}, frame_from_above(0, {}));
  int total = 0;
  for (int const count : look.floor->by_state) {
    total += count;
  }
  EXPECT_EQ(total, 900);
  EXPECT_EQ(look.floor.value()[PointState::kAgrees], 900);
}

}  // namespace
}  // namespace credo::test
