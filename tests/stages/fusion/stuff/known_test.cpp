#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "stages/fusion/findings.hpp"
#include "stages/fusion/room.hpp"
#include "stages/fusion/stuff/items.hpp"
#include "stages/fusion/stuff/table_views.hpp"

// Things that a frame takes for floor, wall or a known object, where they stand as before.
namespace credo {
namespace {

using test::Board;
using test::kFrame_ns;
using test::Room;

constexpr LabelCode kFirst = kFirstStuff;

class KnownByNow : public testing::TestWithParam<LabelCode> {};

TEST_P(KnownByNow, WhatShowsAsSuchForLongWasThat) {
  Room room;
  room.show({.boards = {{kFirst}}}, 60);
  double const before = room.stuff().at(0).log_odds;
  room.show({.boards = {{GetParam()}}}, 3);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].evidence, Evidence::kNotSeen);
  EXPECT_LT(room.stuff()[0].log_odds, before) << "what is there is no thing of its own";
  EXPECT_GT(room.stuff()[0].log_odds, 0.0) << "but a frame may err";
  room.show({.boards = {{GetParam()}}}, 50);
  EXPECT_TRUE(room.stuff().empty());
}

INSTANTIATE_TEST_SUITE_P(Kinds, KnownByNow, testing::Values(kFloor, kFirstWall, kFirstObject + 2));

/// As it is shown a thing at 1.5 m, and then 60 frames in which it shows as a known object and a
/// wall 3 cm farther away, which has the part `of_wall`.
FusedStuff shown_as_object_and_wall(double of_wall) {
  constexpr LabelCode kObject = kFirstObject + 2;
  FusedStuff stuff;
  for (int i = 0; i < 70; ++i) {
    double const width_m = 0.2 * (1.0 - of_wall);
    test::View view{
        .boards = {{kObject, 0.0, 0.0, width_m}, {kFirstWall, width_m, 0.0, 0.2 * of_wall}},
        .stamp_ns = kFrame_ns * i};
    if (i < 10) {
      view.boards = {{kFirst}};
    }
    Segmentation frame = test::segmentation_of(view);
    frame.walls.emplace_back(
        WallObservation{kFirstWall, {-Eigen::Vector3d::UnitZ(), -1.53}, {}, 1});
    stuff = fused_items(std::move(stuff), frame, KnownPlaces({}, {}), 1e-9 * kFrame_ns, {});
  }
  return stuff;
}

// Objects have no plane that a thing might stand before.
TEST(StuffItems, WhatShowsForTheMostPartAsAnObjectIsNotHeldAgainstTheWallBeside) {
  EXPECT_TRUE(shown_as_object_and_wall(0.4).stuff.empty());
  EXPECT_EQ(shown_as_object_and_wall(0.6).stuff.size(), 1U);
}

/// A thing 2 cm before a place where a wall may be believed, and then, as the camera turns away,
/// such a frame.
FusedStuff shown_at_wall(bool believed, Board const& board, double x_m) {
  BeliefState belief;
  if (believed) {
    WallBelief& wall = belief.walls.emplace_back();
    wall.plane_world = {-Eigen::Vector3d::UnitZ(), -1.5};
    wall.segment_start_m = {-2, 0};
    wall.segment_end_m = {2, 0};
    wall.log_odds = 1.0;
  }
  FusedStuff stuff;
  for (int i = 0; i < 6; ++i) {
    test::View view{.boards = {{kFirst, -0.2, 0.0, 0.2, 0.2, 1.48}}, .stamp_ns = kFrame_ns * i};
    if (i == 5) {
      view.boards = {board};
      view.x_m = x_m;
    }
    stuff = fused_items(std::move(stuff), test::segmentation_of(view), KnownPlaces(belief, {}),
                        1e-9 * kFrame_ns, {});
  }
  return stuff;
}

// The view ends 0.8 m to the left of its middle: 2 cm of the thing are in it. It stands before the
// wall, but not so far that the wall would not agree with it.
TEST(StuffItems, WallBesideAThingIsNotTakenForIt) {
  Board const strip{kFirst, -0.2, 0.0, 0.8, 0.2, 1.5};
  FusedStuff const on_wall = shown_at_wall(true, strip, 0.78);
  ASSERT_EQ(on_wall.stuff.size(), 1U) << "and nothing new";
  EXPECT_FALSE(on_wall.stuff[0].label.has_value());
  EXPECT_LT(on_wall.stuff[0].latest().bounds_world.max().x(), 0.02F);
  FusedStuff const in_the_open = shown_at_wall(false, strip, 0.78);
  ASSERT_EQ(in_the_open.stuff.size(), 1U);
  EXPECT_TRUE(in_the_open.stuff[0].label.has_value());
  EXPECT_GT(in_the_open.stuff[0].latest().bounds_world.max().x(), 0.5F);
}

// The same strip, when the thing's own place shows in it for the most part.
TEST(StuffItems, OfWhatShowsInAWallsClusterNothingIsTold) {
  Board const strip{kFirst, -0.2, 0.0, 0.8, 0.2, 1.5};
  EXPECT_EQ(shown_at_wall(true, strip, 0.0).stuff.at(0).why.news, 0.0);
  EXPECT_GT(shown_at_wall(false, strip, 0.0).stuff.at(0).why.news, 0.0);
}

// However near to the wall it is measured.
TEST(StuffItems, WhatIsAThingForTheMostPartIsThatOnAWallToo) {
  Board const itself{kFirst, -0.2, 0.0, 0.2, 0.2, 1.49};
  FusedStuff const on_wall = shown_at_wall(true, itself, 0.0);
  ASSERT_EQ(on_wall.stuff.size(), 1U);
  EXPECT_TRUE(on_wall.stuff[0].label.has_value());
}

// Nothing in the world has changed: such a look counts by what is news in it, and so does the one
// that shows the thing by itself again.
TEST(StuffItems, WhatAFrameTakesForAWallHasNotGone) {
  Room room;
  room.show({.boards = {{kFirst}}}, 60);
  double const before = room.stuff().at(0).log_odds;
  room.show({.boards = {{kFirstWall}}});
  double const news = room.stuff().at(0).why.news;
  EXPECT_NEAR(news, 1.0 - std::exp(-1e-9 * kFrame_ns / 0.25), 1e-6);
  EXPECT_NEAR(room.stuff()[0].log_odds, before + log_odds_step({Verdict::kGone, 1.0}, news), 1e-9);
  room.show({.boards = {{kFirst}}});
  EXPECT_NEAR(room.stuff().at(0).why.news, news, 1e-6);
}

// What is seen through afterwards is news in full.
TEST(StuffItems, WhatWasTakenForAWallMayGo) {
  Room room;
  room.show({.boards = {{kFirst}}}, 60);
  room.show({.boards = {{kFirstWall}}});
  room.show({});
  EXPECT_EQ(room.stuff().at(0).why.news, 1.0);
  EXPECT_EQ(room.stuff()[0].evidence, Evidence::kSeenThrough);
}

// However long it shows as such, it is no other thing before that is the likelier.
TEST(StuffItems, WhatIsBelievedIsNotForgottenForAnotherName) {
  Room room;
  room.show({.boards = {{kFirst}}}, 60);
  double last = 0.0;
  int frames = 0;
  for (; !room.stuff().empty() && frames < 100; ++frames) {
    last = room.stuff()[0].log_odds;
    room.show({.boards = {{kFirstWall}}});
  }
  EXPECT_GT(frames, 30);
  EXPECT_LT(frames, 60);
  EXPECT_LT(last, 0.2);
}

// One look against one: what was likely stays so, what was not does not.
TEST(StuffItems, WhatWasSeenOnceAndIsThenTakenForAWallIsBelievedLess) {
  for (auto const& [born, least, most] : {std::tuple{0.85, 0.5, 0.8}, {0.62, 0.2, 0.5}}) {
    Room room(test::kWithoutSight, born);
    room.show({.boards = {{kFirst}}});
    room.show({.boards = {{kFirstWall}}});
    ASSERT_EQ(room.stuff().size(), 1U);
    EXPECT_GT(probability_of(room.stuff()[0].log_odds), least);
    EXPECT_LT(probability_of(room.stuff()[0].log_odds), most);
    double const after = room.stuff()[0].log_odds;
    room.show({.boards = {{kFirstWall}}});
    EXPECT_LT(room.stuff().at(0).why.news, 0.2) << "the next looks repeat it";
    EXPECT_LT(room.stuff()[0].log_odds, after);
  }
}

// A detector has found it: that is a change. Where it was in sight already, another name is none.
TEST(StuffItems, WhatShowsToBeAnObjectThatWasFoundSinceIsThat) {
  constexpr LabelCode kObject = kFirstObject + 2;
  Board const elsewhere{kObject, 0.4, 0.0};
  for (bool const was_in_sight : {false, true}) {
    Room room(test::kWithSight);
    room.show({.boards = {{kFirst}}}, 60);
    if (was_in_sight) {
      room.show({.boards = {{kFirst}, elsewhere}});
    }
    double const before = room.stuff().at(0).log_odds;
    room.show({.boards = {{kObject}, elsewhere}});
    ASSERT_EQ(room.stuff().size(), 1U);
    EXPECT_EQ(room.stuff()[0].evidence, Evidence::kNotSeen);
    EXPECT_EQ(room.stuff()[0].log_odds < before - 2.0, !was_in_sight);
    EXPECT_EQ(room.stuff()[0].why.news == 1.0, !was_in_sight);
  }
}

}  // namespace
}  // namespace credo
