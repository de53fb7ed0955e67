#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "stages/fusion/room.hpp"
#include "stages/fusion/stuff_findings.hpp"
#include "stages/fusion/stuff_items.hpp"
#include "stages/fusion/table_views.hpp"

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
