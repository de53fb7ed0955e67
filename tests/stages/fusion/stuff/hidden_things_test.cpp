#include "stages/fusion/stuff/hidden_things.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "stages/fusion/room.hpp"
#include "stages/fusion/stuff/table_views.hpp"

// What passes behind a pole comes out on its other side.
namespace credo {
namespace {

using test::Board;
using test::kWithSight;
using test::Room;

constexpr LabelCode kFirst = kFirstStuff;
constexpr LabelCode kSecond = kFirstStuff + 1;

Board const kKnown{kFirst, 0.0, 0.0, 0.2, 0.2};
/// Before all of it, and a little more.
Board const kPole{std::nullopt, 0.0, -0.2, 0.17, 0.6, 1.2};
/// Of the same thing, where nothing was seen of it.
Board const kOtherSide{kSecond, -0.06, 0.0, 0.06, 0.2};

Room room_with_a_thing() {
  Room room;
  room.show({.boards = {kKnown}}, 10);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
  return room;
}

TEST(HiddenThings, WhatComesOutOnTheOtherSideIsTheSameThing) {
  Room room = room_with_a_thing();
  room.show({.boards = {kPole}}, 3);
  double const believed = room.stuff()[0].log_odds;
  room.show({.boards = {kPole, kOtherSide}});
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].label, kSecond);
  EXPECT_EQ(room.stuff()[0].log_odds, believed);
  room.show({.boards = {kPole, kOtherSide}}, 20);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_LT(room.stuff()[0].latest().bounds_world.min().x(), -0.04F);
  // In front of it again, it is one.
  room.show({.boards = {{kFirst, -0.06, 0.0, 0.26, 0.2}}}, 20);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

TEST(HiddenThings, WhatDoesNotTouchItIsAnother) {
  for (Board const& other :
       {Board{kSecond, -0.16, 0.0, 0.06, 0.2}, Board{kSecond, -0.06, 0.0, 0.06, 0.2, 1.3}}) {
    Room room = room_with_a_thing();
    room.show({.boards = {kPole, other}});
    EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  }
}

TEST(HiddenThings, WhatIsMuchLargerIsAnother) {
  Room room = room_with_a_thing();
  room.show({.boards = {kPole, {kSecond, -0.4, -0.2, 0.4, 0.5}}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// A quarter of it and more touches what is hidden.
TEST(HiddenThings, WhatIsTallerIsAnother) {
  Room room = room_with_a_thing();
  room.show({.boards = {kPole}});
  room.show({.boards = {kPole, {kSecond, -0.03, -0.1, 0.03, 0.4}}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// As near before it as what touches it.
TEST(HiddenThings, WhatHidesItIsAnother) {
  Room room = room_with_a_thing();
  room.show({.boards = {kPole}});
  room.show({.boards = {{kSecond, -0.02, -0.02, 0.24, 0.24, 1.473}}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// Half of it shows, if as nothing's surface: that is no thing whose other side is to be expected.
TEST(HiddenThings, WhatTouchesSomethingHalfHiddenIsAnother) {
  Room room = room_with_a_thing();
  Board const half_a_pole{std::nullopt, 0.0, -0.2, 0.08, 0.6, 1.2};
  Board const its_surface{std::nullopt, 0.0, 0.0, 0.2, 0.2};
  room.show({.boards = {half_a_pole, its_surface, kOtherSide}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

TEST(HiddenThings, BesideWhatShowsItIsAnother) {
  Room room = room_with_a_thing();
  room.show({.boards = {kKnown, kOtherSide}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// The frame before saw through there: it has been put there.
TEST(HiddenThings, WhatArrivesIsAnother) {
  Room room(kWithSight);
  room.show({.boards = {kKnown}}, 10);
  room.show({.boards = {kPole}}, 3);
  room.show({.boards = {kPole, kOtherSide}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

}  // namespace
}  // namespace credo
