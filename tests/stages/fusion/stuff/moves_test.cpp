#include "stages/fusion/stuff/moves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stages/fusion/room.hpp"
#include "stages/fusion/stuff/table_views.hpp"

// Things that walk: they keep their name, and are not believed where they were.
namespace credo {
namespace {

using test::Board;
using test::kFrame_ns;
using test::Room;

constexpr LabelCode kFirst = kFirstStuff;
constexpr LabelCode kSecond = kFirstStuff + 1;
constexpr double kFrame_s = 1e-9 * kFrame_ns;
constexpr double kElsewhere_m = 30.0;
// Nobody walks farther in a frame.
constexpr double kStep_m = 0.06;

Board person(double left_m, double z_m, LabelCode label = kFirst) {
  return {label, left_m, -0.4, 0.3, 0.8, z_m};
}

/// 8 frames of somebody who comes nearer.
void approach(Room& room) {
  room.show({});
  for (int k = 0; k < 8; ++k) {
    room.show({.boards = {person(-0.15, 2.6 - 0.1 * k)}});
  }
}

TEST(StuffMoves, WhatComesNearerKeepsItsNameAndHidesNothing) {
  Room room(test::kWithSight);
  approach(room);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].label, kFirst);
  EXPECT_NEAR(room.stuff()[0].latest().centroid_world.z(), 1.9F, 0.01F);
  EXPECT_EQ(room.stuff()[0].history_count, 8U);
  EXPECT_TRUE(is_on_its_way(room.stuff()[0]));
  EXPECT_GT(probability_of(room.stuff()[0].log_odds), 0.7);
}

// At its new place's edge the cluster has some pixels of what is far behind.
TEST(StuffMoves, WhatWasMovedKeepsItsNameThoughSomePixelsBehindItShowWithIt) {
  Room room(test::kWithSight);
  room.show({.boards = {{kFirst, -0.25, 0.0}}}, 4);
  room.show({.boards = {{kFirst, 0.1, 0.0}, {kFirst, 0.62, 0.1, 0.06, 0.06, 2.9}}});
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].label, kFirst);
}

// That it came says that it may go on, whatever is believed of it.
TEST(StuffMoves, WhatHasJustComeIsFollowedHoweverMuchItIsBelieved) {
  Room room(test::kWithSight, 0.97);
  room.show({});
  room.show({.boards = {person(-0.15, 2.0)}}, 2);
  ASSERT_GT(probability_of(room.stuff()[0].log_odds), 0.8);
  room.show({.boards = {person(-0.15, 1.8)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

// Without a look at its place before, it might have stood there unseen.
TEST(StuffMoves, WhatComesIntoViewBeforeWhatIsLikeItIsNotThat) {
  Room room(test::kWithSight);
  room.show({});
  room.show({.boards = {person(-0.15, 2.0)}});
  // The sight of the frame before is of another place.
  room.show({.x_m = kElsewhere_m});
  room.show({.boards = {person(-0.15, 1.8)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// No cluster is taken for it, but most of it still shows.
TEST(StuffMoves, WhatIsHiddenInPartHasNotGone) {
  Room room(test::kWithSight);
  room.show({});
  room.show({.boards = {person(-0.15, 2.0)}});
  Board unexplained = person(-0.15, 2.0);
  unexplained.label.reset();
  room.show({.boards = {unexplained, person(-0.32, 1.8)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// However little it is believed.
TEST(StuffMoves, WhatWasSeenFourTimesHasNotJustCome) {
  Room room(test::kWithSight, 0.3);
  room.show({.boards = {person(-0.15, 2.0)}}, 4);
  ASSERT_LT(probability_of(room.stuff()[0].log_odds), 0.6);
  room.show({.boards = {person(-0.15, 1.8)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

TEST(StuffMoves, WhatStoodStillIsNotLostBehindWhatIsLikeIt) {
  Room room(test::kWithSight);
  room.show({.boards = {person(-0.15, 2.0)}}, 4);
  double const believed = room.stuff()[0].log_odds;
  room.show({.boards = {person(-0.15, 1.8)}}, 30);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  EXPECT_EQ(room.stuff()[0].log_odds, believed);
  EXPECT_EQ(room.stuff()[0].evidence, Evidence::kOccluded);
}

// Where it is then nobody could have come past it from one frame to the next.
TEST(StuffMoves, WhatStoodStillAndComesNearerKeepsItsName) {
  Room room(test::kWithSight);
  room.show({.boards = {person(-0.15, 2.0)}}, 40);
  for (int k = 1; k <= 5; ++k) {
    room.show({.boards = {person(-0.15, 2.0 - kStep_m * k)}});
    ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
    EXPECT_EQ(room.stuff()[0].label, kFirst);
    EXPECT_NEAR(room.stuff()[0].latest().centroid_world.z(), 2.0 - kStep_m * k, 0.01);
    EXPECT_TRUE(is_on_its_way(room.stuff()[0]));
  }
  room.show({.boards = {person(-0.15, 2.0 - kStep_m * 5)}}, 20);
  EXPECT_FALSE(is_on_its_way(room.stuff()[0])) << "it stands still again";
}

// Once it has, it is followed as what came.
TEST(StuffMoves, WhatHasSetOutMayHurry) {
  Room room(test::kWithSight);
  room.show({.boards = {person(-0.15, 2.0)}}, 10);
  room.show({.boards = {person(-0.15, 2.0 - kStep_m)}});
  room.show({.boards = {person(-0.15, 2.0 - 3 * kStep_m)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

TEST(StuffMoves, WhatIsThinMayStandBehindWhatIsLikeIt) {
  Room room(test::kWithSight);
  Board const post = {kFirst, -0.02, -0.4, 0.04, 0.8, 2.0};
  room.show({.boards = {post}}, 10);
  Board nearer = post;
  nearer.z_m = 2.0 - kStep_m;
  room.show({.boards = {nearer}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

TEST(StuffMoves, WhatIsLargerBeforeWhatStoodStillIsNotThat) {
  Room room(test::kWithSight);
  room.show({.boards = {person(-0.15, 2.0)}}, 10);
  room.show({.boards = {{kFirst, -0.4, -0.7, 0.8, 1.4, 2.0 - kStep_m}}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// Of a sliver's surroundings most may be its edge: that says nothing of what is there.
TEST(StuffMoves, WhatIsOnItsWayIsFollowedToWhereASliverOfItShows) {
  auto const sliver = [](double width_m, double z_m) {
    return Board{kFirst, -0.5 * width_m, -0.4, width_m, 0.8, z_m};
  };
  Room room(test::kWithSight);
  room.show({});
  for (int k = 0; k < 8; ++k) {
    room.show({.boards = {sliver(0.05, 2.6 - 0.1 * k)}});
  }
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  ASSERT_TRUE(is_on_its_way(room.stuff()[0]));
  room.show({.boards = {sliver(0.025, 1.8)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

// Three looks, but nobody saw it come.
TEST(StuffMoves, WhatWasThereFromTheFirstIsNotLostBehindWhatIsLikeIt) {
  Room room(test::kWithSight);
  room.show({.boards = {person(-0.15, 2.0)}}, 3);
  room.show({.boards = {person(-0.15, 1.8)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// One look says nothing of whether it stands still.
TEST(StuffMoves, WhatWasSeenOnceMayHaveCome) {
  Room room(test::kWithSight);
  room.show({.boards = {person(-0.15, 2.0)}});
  room.show({.boards = {person(-0.15, 1.8)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

// It has stood there all the time, though one look alone showed it by itself.
TEST(StuffMoves, WhatShowedInOneWithSomethingElseSinceHasNotJustCome) {
  for (int const looks_as_one : {0, 2}) {
    Room room(test::kWithSight);
    room.show({.boards = {{kFirst, -0.4, 0.0, 0.4, 0.12}, {kSecond, 0.0, 0.0, 0.1, 0.12}}});
    room.show({.boards = {{kFirst, -0.4, 0.0, 0.5, 0.12}}}, looks_as_one);
    ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
    room.show({.boards = {{kFirst, -0.4, 0.0, 0.4, 0.12}, {kSecond, 0.0, 0.0, 0.1, 0.12, 1.35}}});
    EXPECT_EQ(room.ids().size(), looks_as_one > 0 ? 3U : 2U);
  }
}

// Where the frame before could not see: at the edge of the image, for one.
TEST(StuffMoves, WhatIsOnItsWayIsFollowedToWhereNobodySaw) {
  Room room(test::kWithSight);
  approach(room);
  ASSERT_TRUE(is_on_its_way(room.stuff()[0]));
  room.show({.x_m = kElsewhere_m});
  room.show({.boards = {person(-0.15, 1.7)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

TEST(StuffMoves, WhatIsFarTooLargeIsAnother) {
  Room room(test::kWithSight);
  room.show({});
  room.show({.boards = {{kFirst, -0.05, -0.05, 0.1, 0.1, 2.0}}}, 2);
  room.show({.boards = {{kFirst, -0.5, -0.5, 1.0, 1.0, 1.8}}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  Room other(test::kWithSight);
  other.show({});
  other.show({.boards = {{kFirst, -0.05, -0.05, 0.1, 0.1, 2.0}}}, 2);
  other.show({.boards = {{kFirst, -0.1, -0.1, 0.2, 0.2, 1.8}}});
  EXPECT_THAT(other.ids(), testing::ElementsAre(1U));
}

TEST(StuffMoves, WhatIsTooFarOffIsAnother) {
  Room room(test::kWithSight);
  room.show({});
  room.show({.boards = {person(-0.15, 2.6)}}, 2);
  room.show({.boards = {person(-0.15, 2.05)}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

// For a frame, the segmentation joins it to a door behind it.
TEST(StuffMoves, WhatIsOneWithWhatStandsBehindItKeepsItsName) {
  Board const door{kSecond, 0.25, -0.3, 0.4, 0.6, 2.8};
  Room room(test::kWithSight);
  room.show({.boards = {door}}, 10);
  for (int k = 0; k < 8; ++k) {
    room.show({.boards = {door, person(-0.15, 2.6 - 0.1 * k)}});
  }
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  ASSERT_TRUE(is_on_its_way(room.stuff()[1]));
  double const believed = room.stuff()[0].log_odds;
  Board joined = door;
  joined.label = kFirst;
  for (int k = 8; k < 14; ++k) {
    room.show({.boards = {joined, person(-0.15, 2.6 - 0.1 * k)}});
    ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
    EXPECT_EQ(room.stuff()[1].label, kFirst);
    EXPECT_LT(room.stuff()[1].latest().bounds_world.sizes().z(), 0.1F) << "none of it is the door";
    EXPECT_EQ(room.stuff()[0].evidence, Evidence::kSeen);
    EXPECT_GE(room.stuff()[0].log_odds, believed);
  }
  room.show({.boards = {door, person(-0.15, 1.1)}});
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  EXPECT_EQ(room.stuff()[0].label, kSecond);
  EXPECT_EQ(room.stuff()[1].label, kFirst);
}

// A person who comes up beside a cupboard is not that.
TEST(StuffMoves, WhatIsForTheLesserPartOfAClusterIsNotTheCluster) {
  Board const cupboard{kFirst, 0.2, -0.8, 1.0, 1.6, 2.0};
  Room room(test::kWithSight);
  room.show({.boards = {cupboard}}, 10);
  for (int k = 0; k < 8; ++k) {
    room.show({.boards = {cupboard, person(-0.15, 2.6 - 0.1 * k, kSecond)}});
  }
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {cupboard, person(-0.15, 1.8)}});
  EXPECT_EQ(room.stuff().at(0).label, kFirst);
  EXPECT_FALSE(room.stuff().at(1).label);
}

TEST(StuffMoves, WhatWalksAcrossKeepsItsNameAndItsSize) {
  Room room(test::kWithSight);
  room.show({});
  for (int k = 0; k < 16; ++k) {
    room.show({.boards = {person(-0.9 + 0.1 * k, 2.0)}});
  }
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_TRUE(is_on_its_way(room.stuff()[0]));
  EXPECT_LT(room.stuff()[0].latest().bounds_world.sizes().x(), 0.45F);
}

TEST(StuffMoves, WhatWalkedOutOfViewIsBelievedForASecond) {
  Room room(test::kWithSight);
  approach(room);
  double const believed = probability_of(room.stuff()[0].log_odds);
  for (int k = 1; k <= 15; ++k) {
    room.show({.x_m = kElsewhere_m});
    ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
    EXPECT_NEAR(probability_of(room.stuff()[0].log_odds), believed * std::exp(-k * kFrame_s / 0.5),
                1e-9);
    EXPECT_EQ(room.stuff()[0].evidence, Evidence::kOutOfView);
  }
  room.show({.x_m = kElsewhere_m}, 20);
  EXPECT_TRUE(room.stuff().empty());
}

TEST(StuffMoves, WhatHasStoppedIsKept) {
  Room room(test::kWithSight);
  approach(room);
  room.show({.boards = {person(-0.15, 1.9)}}, 20);
  EXPECT_FALSE(is_on_its_way(room.stuff()[0]));
  double const believed = room.stuff()[0].log_odds;
  room.show({.x_m = kElsewhere_m}, 60);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].log_odds, believed);
}

TEST(StuffMoves, ItIsOnItsWayThatMovedAtThreeOfTenLooks) {
  StuffBelief item;
  item.history_count = 1;
  count_look(item, true);
  count_look(item, true);
  EXPECT_FALSE(is_on_its_way(item)) << "three looks";
  count_look(item, false);
  EXPECT_TRUE(is_on_its_way(item)) << "two of four";
  count_look(item, false);
  count_look(item, false);
  EXPECT_TRUE(is_on_its_way(item)) << "two of six";
  count_look(item, false);
  EXPECT_FALSE(is_on_its_way(item)) << "two of seven";
  EXPECT_EQ(item.history_count, 7U);
}

TEST(StuffMoves, OnlyTheLastLooksCount) {
  StuffBelief item;
  for (int k = 0; k < 500; ++k) {
    count_look(item, false);
  }
  int looks = 0;
  while (!is_on_its_way(item)) {
    count_look(item, true);
    ++looks;
  }
  // (35/36)^13 is the first below 0.7.
  EXPECT_EQ(looks, 13);
}

TEST(StuffMoves, ALookThroughAThirdSaysThatItMoved) {
  PointCounts look;
  look[PointState::kAgrees] = 65;
  look[PointState::kSeenThrough] = 35;
  look[PointState::kOccluded] = 1000;
  EXPECT_FALSE(has_moved(look));
  look[PointState::kSeenThrough] = 36;
  EXPECT_TRUE(has_moved(look));
  EXPECT_FALSE(has_moved({}));
}

TEST(StuffMoves, LosingSightIsAccountedFor) {
  StuffBelief item;
  item.log_odds = log_odds_of(0.8);
  lose_sight_of(item, 1.0, {});
  EXPECT_NEAR(probability_of(item.log_odds), 0.8 * std::exp(-2.0), 1e-12);
  EXPECT_NEAR(item.why.moved, item.log_odds - log_odds_of(0.8), 1e-12);
  double const before = item.log_odds;
  lose_sight_of(item, 0.0, {});
  EXPECT_NEAR(item.log_odds, before, 1e-12);
}

}  // namespace
}  // namespace credo
