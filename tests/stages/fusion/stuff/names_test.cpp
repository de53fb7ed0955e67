#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "stages/fusion/room.hpp"
#include "stages/fusion/stuff/items.hpp"
#include "stages/fusion/stuff/one_with.hpp"
#include "stages/fusion/stuff/table_views.hpp"

// Which clusters are one thing, which are two, and what each is called.
namespace credo {
namespace {

using test::Board;
using test::Room;
using test::View;

constexpr LabelCode kFirst = kFirstStuff;
constexpr LabelCode kSecond = kFirstStuff + 1;

TEST(StuffItems, WhatIsSeenInPiecesIsOneThing) {
  Room room;
  room.show({.boards = {{kFirst}}}, 3);
  Board const left{kFirst, 0.0, 0.0, 0.12, 0.2};
  Board const right{kSecond, 0.12, 0.0, 0.08, 0.2};
  room.show({.boards = {left, right}}, 15);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].label, kFirst);
  EXPECT_EQ(room.stuff()[0].latest().pixel_count, 400U);
}

// As one at first, then in two for long: they are two.
TEST(StuffItems, WhatShowsInTwoForLongBecomesTwo) {
  Room room;
  room.show({.boards = {{kFirst}}}, 3);
  double const believed = room.stuff()[0].log_odds;
  Board const left{kFirst, 0.0, 0.0, 0.12, 0.2};
  Board const right{kSecond, 0.12, 0.0, 0.08, 0.2};
  room.show({.boards = {left, right}}, 60);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  EXPECT_EQ(room.stuff()[0].label, kFirst);
  EXPECT_EQ(room.stuff()[1].label, kSecond);
  EXPECT_LT(room.stuff()[0].latest().bounds_world.max().x(), 0.13F);
  EXPECT_GE(room.stuff()[1].log_odds, believed);
}

// Where something before it cuts it in two, that says nothing: it was seen to go on there. Where
// both pieces lie side by side it does.
TEST(StuffItems, WhatSomethingElseCutsInTwoStaysOne) {
  Board const left{kFirst, 0.0, 0.0, 0.18, 0.2};
  Board const right{kSecond, 0.24, 0.0, 0.16, 0.2};
  Board const leg{std::nullopt, 0.14, -0.1, 0.06, 0.4, 1.2};
  for (bool const cut : {true, false}) {
    Room room;
    room.show({.boards = {{kFirst, 0.0, 0.0, 0.4, 0.2}}}, 3);
    Board wider = right;
    wider.left_m = 0.18;
    wider.width_m = 0.22;
    room.show({.boards = cut ? std::vector{left, right, leg} : std::vector{left, wider}}, 60);
    EXPECT_EQ(room.ids().size(), cut ? 1U : 2U);
    // Nor has it said so before when nothing does any more.
    room.show({.boards = {left, wider}});
    EXPECT_EQ(room.ids().size(), cut ? 1U : 2U);
  }
}

// What hides less of the border than is seen of it cuts nothing: side by side in sight, the two are
// told apart there.
TEST(StuffItems, WhatSomethingElseHardlyHidesBecomesTwo) {
  Board const left{kFirst, 0.0, 0.0, 0.18, 0.2};
  Board const right{kSecond, 0.18, 0.0, 0.22, 0.2};
  Board const knob{std::nullopt, 0.11, -0.1, 0.06, 0.15, 1.2};
  Room room;
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.4, 0.2}}}, 3);
  room.show({.boards = {left, right, knob}}, 60);
  EXPECT_EQ(room.ids().size(), 2U);
}

// Though more and more of the piece is seen, of which nothing was to be seen before.
TEST(StuffItems, WhatShowsInTwoBecomesTwoWhileMoreOfItComesToBeSeen) {
  Room room;
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.4, 0.2}}}, 3);
  Board const left{kFirst, 0.0, 0.0, 0.32, 0.2};
  for (int k = 0; k < 20; ++k) {
    room.show({.boards = {left, {kSecond, 0.32, 0.0, 0.08 + 0.01 * k, 0.2}}});
  }
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// A strip of it showed in one with a thing beside it; the rest comes into view in a few frames.
TEST(StuffItems, WhatComesIntoViewBesideAThingIsNotLearntStripByStrip) {
  Room room;
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.44, 0.2}}}, 3);
  Board const left{kFirst, 0.0, 0.0, 0.4, 0.2};
  for (double const width_m : {0.06, 0.09, 0.13, 0.19, 0.28}) {
    room.show({.boards = {left, {kSecond, 0.4, 0.0, width_m, 0.2}}});
  }
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  EXPECT_LT(room.stuff()[0].latest().bounds_world.max().x(), 0.47F);
}

// First in two pieces, then for long as one: the two were one.
TEST(StuffItems, WhatShowsAsOneForLongBecomesOne) {
  Room room;
  Board const left{kFirst, 0.0, 0.0, 0.12, 0.2};
  Board const right{kSecond, 0.12, 0.0, 0.08, 0.2};
  room.show({.boards = {left, right}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {{kFirst}}}, 4);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {{kFirst}}}, 2);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

// What shows as one behind the other is two, however long the frames' clusters hold both. A step
// within which a thing may be off is none.
TEST(StuffItems, WhatStandsBehindAnotherDoesNotBecomeOneWithIt) {
  for (double const behind_m : {0.0, 0.02, 0.05, 0.3}) {
    Room room;
    Board const front{kFirst, 0.0, 0.0, 0.12, 0.2};
    Board const back{kSecond, 0.12, 0.0, 0.1, 0.2, 1.5 + behind_m};
    room.show({.boards = {front, back}}, 3);
    ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
    Board back_with_it = back;
    back_with_it.label = kFirst;
    room.show({.boards = {front, back_with_it}}, 60);
    EXPECT_EQ(room.ids().size(), behind_m > 0.03 ? 2U : 1U) << behind_m;
    room.show({.boards = {front, back}});
    EXPECT_EQ(room.ids().size(), behind_m > 0.03 ? 2U : 1U) << behind_m;
  }
}

// The longer the two showed by themselves, up to some twelve looks, the longer it takes.
TEST(StuffItems, WhatShowedInTwoForLongStaysTwoForLonger) {
  Room room;
  Board const left{kFirst, 0.0, 0.0, 0.12, 0.2};
  Board const right{kSecond, 0.12, 0.0, 0.08, 0.2};
  room.show({.boards = {left, right}}, 30);
  room.show({.boards = {{kFirst}}}, 6);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {{kFirst}}}, 2);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

// Of what is small in the image the segmentation tells less.
TEST(StuffItems, WhatIsSmallBecomesOneLater) {
  Room room;
  Board const left{kFirst, 0.0, 0.0, 0.06, 0.1};
  Board const right{kSecond, 0.06, 0.0, 0.04, 0.1};
  room.show({.boards = {left, right}});
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.1, 0.1}}}, 6);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.1, 0.1}}}, 30);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(counts_as_one(0), 0.0);
  EXPECT_EQ(counts_as_one(4), 0.0);
  EXPECT_NEAR(counts_as_one(25), 0.576, 1e-12);
  EXPECT_NEAR(counts_as_one(100), 1.024, 1e-12);
  EXPECT_NEAR(counts_as_one(400), 1.296, 1e-12);
}

// Several small things that stand side by side often show as one, if they were told apart before.
TEST(StuffItems, WhatIsSmallAndShowedInTwoForLongStaysTwo) {
  Room room;
  Board const left{kFirst, 0.0, 0.0, 0.08, 0.1};
  Board const right{kSecond, 0.08, 0.0, 0.08, 0.1};
  room.show({.boards = {left, right}}, 12);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.16, 0.1}}}, 12);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// Of what is large it tells more.
TEST(StuffItems, WhatIsLargeBecomesOneSooner) {
  Room room;
  Board const left{kFirst, 0.0, 0.0, 0.2, 0.2};
  Board const right{kSecond, 0.2, 0.0, 0.2, 0.2};
  Board const both{kFirst, 0.0, 0.0, 0.4, 0.2};
  room.show({.boards = {left, right}}, 2);
  room.show({.boards = {both}}, 3);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {both}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

// One look against one, if what it shows is large.
TEST(StuffItems, WhatOneLookAloneShowedInTwoBecomesOneAtOnceIfItIsLarge) {
  for (double const height_m : {0.06, 0.2}) {
    Room room;
    Board const left{kFirst, 0.0, 0.0, 0.2, height_m};
    Board const right{kSecond, 0.2, 0.0, 0.2, height_m};
    room.show({.boards = {left, right}});
    ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
    room.show({.boards = {{kFirst, 0.0, 0.0, 0.4, height_m}}});
    EXPECT_EQ(room.ids().size(), height_m > 0.1 ? 1U : 2U);
  }
}

// A segmentation that cannot decide shows one thing; one that errs now and then shows two.
TEST(StuffItems, WhatShowsAsOneEverySecondTimeIsOneAndWhatHardlyEverDoesIsTwo) {
  Board const left{kFirst, 0.0, 0.0, 0.12, 0.2};
  Board const right{kSecond, 0.12, 0.0, 0.08, 0.2};
  for (int const times_apart : {1, 9}) {
    Room room;
    for (int k = 0; k < 12; ++k) {
      room.show({.boards = {left, right}}, times_apart);
      room.show({.boards = {{kFirst}}});
    }
    EXPECT_THAT(room.ids(),
                testing::ElementsAreArray(times_apart == 1 ? std::vector<std::uint32_t>{1}
                                                           : std::vector<std::uint32_t>{1, 2}));
  }
}

// The larger one that came later keeps its name.
TEST(StuffItems, OfTwoThatAreOneTheBetterKnownKeepsItsName) {
  Room room;
  Board const left{kFirst, 0.0, 0.0, 0.05, 0.2};
  Board const right{kSecond, 0.05, 0.0, 0.15, 0.2};
  room.show({.boards = {left}});
  room.show({.boards = {left, right}}, 3);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {{kFirst}}}, 10);
  EXPECT_THAT(room.ids(), testing::ElementsAre(2U));
}

// What the better known one shows no more says nothing of what both are called.
TEST(StuffItems, OfTwoThatAreOneTheBetterKnownOfWhatShowsKeepsItsName) {
  Board const wide{kFirst, -0.4, 0.0, 0.4, 0.2};
  Board const narrow{kSecond, 0.0, 0.0, 0.26, 0.2};
  for (bool const hidden : {false, true}) {
    Room room;
    room.show({.boards = {wide, narrow}}, 12);
    ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
    Board const both{kFirst, -0.4, 0.0, 0.66, 0.2};
    Board const in_front{std::nullopt, -0.4, -0.1, 0.28, 0.4, 1.2};
    room.show({.boards = hidden ? std::vector{in_front, both} : std::vector{both}}, 40);
    EXPECT_THAT(room.ids(), testing::ElementsAre(hidden ? 2U : 1U));
  }
}

// However much of the image the other takes up.
TEST(StuffItems, OfAThingInPiecesTheBestKnownIsTheMainOne) {
  Room room;
  Board const known{kFirst, 0.0, 0.0, 0.12, 0.2};
  room.show({.boards = {known}}, 12);
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.28, 0.2}}}, 2);
  Board const larger{kSecond, 0.12, 0.0, 0.16, 0.2};
  room.show({.boards = {known, larger}});
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].label, kFirst);
}

TEST(StuffItems, WhatBecomesOneWithAnotherIsToldInThatFrameAlone) {
  Room room;
  Board const left{kFirst, 0.0, 0.0, 0.05, 0.2};
  Board const right{kSecond, 0.05, 0.0, 0.15, 0.2};
  room.show({.boards = {left, right}}, 3);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  int told = 0;
  for (int frame = 0; frame < 20; ++frame) {
    std::size_t const before = room.ids().size();
    room.show({.boards = {{kFirst}}});
    bool const joins = room.ids().size() < before;
    for (StuffBelief const& item : room.stuff()) {
      EXPECT_EQ(item.joined_ids.size(), joins ? 1U : 0U) << frame;
      told += joins && item.joined_ids.front() + item.id == 3U ? 1 : 0;
    }
  }
  EXPECT_EQ(told, 1);
}

// A magazine on a table: what is measured agrees with the table, too.
TEST(StuffItems, WhatLiesOnAThingIsAThingOfItsOwn) {
  Room room;
  Board const table{kFirst, -0.4, -0.4, 0.8, 0.8, 1.5};
  Board const magazine{kSecond, 0.0, 0.0, 0.2, 0.2, 1.49, kFirst};
  room.show({.boards = {table}}, 10);
  room.show({.boards = {table, magazine}}, 2);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  EXPECT_EQ(room.stuff()[0].label, kFirst);
  EXPECT_EQ(room.stuff()[1].label, kSecond);
}

// A lid, raised above its box in one frame and not in the next.
TEST(StuffItems, WhatIsAGoodPartOfAThingDoesNotLieOnIt) {
  Room room;
  Board const rim{kFirst, 0.0, 0.0, 0.2, 0.2};
  Board const lid{kSecond, 0.03, 0.03, 0.14, 0.14, 1.499, kFirst};
  room.show({.boards = {rim}}, 10);
  room.show({.boards = {rim, lid}}, 2);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

// One frame took the wall beside it for a part of it.
TEST(StuffItems, WhatShowsAsSomethingElseLeavesTheModel) {
  Room room;
  Board const box{kFirst, 0.0, 0.0, 0.12, 0.2};
  Board const wall{kFirstWall, 0.12, 0.0, 0.08, 0.2};
  room.show({.boards = {box, wall}}, 5);
  room.show({.boards = {{kFirst}}});
  EXPECT_GT(room.stuff()[0].latest().bounds_world.max().x(), 0.18F);
  room.show({.boards = {box, wall}}, 5);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_LT(room.stuff()[0].latest().bounds_world.max().x(), 0.13F);
}

// Of a mug at the edge of what hides it, a strip shows in the table's cluster.
TEST(StuffItems, WhatHardlyShowsDoesNotBecomeOneWithAnother) {
  Room room;
  Board const mug{kFirst, 0.0, 0.0, 0.2, 0.2};
  Board const table{kSecond, 0.2, 0.0, 0.4, 0.2};
  room.show({.boards = {mug, table}}, 3);
  Board const in_front{kSecond + 1, -0.3, -0.3, 0.428, 0.8, 1.2};
  Board const longer_table{kSecond, 0.1, 0.0, 0.5, 0.2};
  room.show({.boards = {in_front, longer_table}}, 40);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U, 3U));
}

// A pose that is not quite right looks past most of it.

}  // namespace
}  // namespace credo
