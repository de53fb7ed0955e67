#include "stages/fusion/stuff/joined_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "stages/fusion/room.hpp"
#include "stages/fusion/stuff/learning.hpp"
#include "stages/fusion/stuff/model.hpp"
#include "stages/fusion/stuff/moves.hpp"
#include "stages/fusion/stuff/table_views.hpp"

// What became one with another and comes apart again is what it was.
namespace credo {
namespace {

using test::Board;
using test::Room;

constexpr LabelCode kFirst = kFirstStuff;
constexpr LabelCode kSecond = kFirstStuff + 1;
constexpr LabelCode kThird = kFirstStuff + 2;

Board const kLeft{kFirst, 0.0, 0.0, 0.2, 0.3};
Board const kRight{kSecond, 0.2, 0.0, 0.14, 0.3};
Board const kBoth{kFirst, 0.0, 0.0, 0.34, 0.3};

/// Two things, of which the second becomes one with the first.
Room joined_room() {
  Room room;
  room.show({.boards = {kLeft, kRight}}, 3);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {kBoth}}, 10);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
  return room;
}

TEST(JoinedNames, WhatComesApartAgainIsCalledAsBefore) {
  Room room = joined_room();
  room.show({.boards = {kLeft, kRight}}, 100);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  EXPECT_EQ(room.stuff()[0].label, kFirst);
  EXPECT_EQ(room.stuff()[1].label, kSecond);
  EXPECT_TRUE(room.stuff()[0].names_kept.empty());
  EXPECT_GT(room.stuff()[1].history_count, 3U);
  // The next name is one that nothing ever had.
  room.show({.boards = {kLeft, kRight, {kThird, -0.4, 0.0}}}, 2);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U, 3U));
}

// Whichever has the smaller id: the belief stays in the order of ids.
TEST(JoinedNames, TheOlderOneToo) {
  Room room;
  Board const old{kSecond, 0.2, 0.0, 0.14, 0.3};
  room.show({.boards = {old}});
  room.show({.boards = {kLeft, old}}, 3);
  room.show({.boards = {kBoth}}, 15);
  ASSERT_THAT(room.ids(), testing::ElementsAre(2U));
  room.show({.boards = {kLeft, old}}, 100);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  EXPECT_EQ(room.stuff()[0].label, kSecond);
}

TEST(JoinedNames, NoIdIsInUseTwice) {
  Room room = joined_room();
  for (int k = 0; k < 8; ++k) {
    room.show({.boards = {kLeft, kRight}}, 60);
    EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
    for (int frame = 0; frame < 60; ++frame) {
      room.show({.boards = {kBoth}});
      for (StuffBelief const& item : room.stuff()) {
        for (std::uint32_t const gone : item.joined_ids) {
          EXPECT_THAT(room.ids(), testing::Not(testing::Contains(gone)));
        }
        for (JoinedThing const& old : item.names_kept) {
          EXPECT_THAT(room.ids(), testing::Not(testing::Contains(old.id)));
        }
      }
    }
    EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
    EXPECT_EQ(room.stuff()[0].names_kept.size(), 1U);
  }
}

TEST(JoinedNames, WhatComesElsewhereIsAnother) {
  for (Board const& other :
       {Board{kThird, 0.4, 0.0, 0.14, 0.3}, Board{kThird, 0.2, 0.0, 0.14, 0.3, 1.2}}) {
    Room room = joined_room();
    room.show({.boards = {kBoth, other}}, 3);
    EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 3U));
  }
}

// It is carried away while the two are one thing, and something else is put there.
TEST(JoinedNames, WhereItWasSeenThroughIsAnother) {
  Room room = joined_room();
  room.show({.boards = {kLeft}}, 3);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_TRUE(room.stuff()[0].names_kept.empty());
  room.show({.boards = {kLeft, kRight}}, 100);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 3U));
}

// What both were hidden by tells nothing of it.
TEST(JoinedNames, WhatIsHiddenIsKept) {
  Room room = joined_room();
  room.show({.boards = {{std::nullopt, -0.1, -0.1, 0.6, 0.6, 1.2}}}, 30);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  room.show({.boards = {kLeft, kRight}}, 100);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
}

/// A board's points 1.5 m away, a centimetre apart.
std::vector<Eigen::Vector3f> board_points(double left_m, double width_m) {
  std::vector<Eigen::Vector3f> points_world;
  for (double x_m = left_m + 0.005; x_m < left_m + width_m; x_m += 0.01) {
    for (double y_m = 0.005; y_m < 0.2; y_m += 0.01) {
      points_world.emplace_back(static_cast<float>(x_m), static_cast<float>(y_m), 1.5F);
    }
  }
  return points_world;
}

StuffBelief thing(std::uint32_t id, double left_m, double width_m) {
  StuffBelief item;
  item.id = id;
  item.history_count = id;
  item.model =
      std::make_shared<StuffModel const>(new_model(board_points(left_m, width_m), 0.2 * width_m));
  return item;
}

/// The name of what a frame shows as its first cluster; it is no longer kept.
std::optional<JoinedThing> taken(std::vector<StuffBelief>& stuff, std::vector<Board> boards) {
  Segmentation const frame = test::segmentation_of({.boards = std::move(boards)});
  return name_of_old(stuff, kFirst, clusters_of(frame).at(0),
                     SightView(frame.sight, frame.T_world_camera));
}

std::optional<std::uint32_t> id_of(std::vector<StuffBelief> stuff, std::vector<Board> boards) {
  std::optional<JoinedThing> const old = taken(stuff, std::move(boards));
  return old ? std::optional(old->id) : std::nullopt;
}

TEST(JoinedNames, AreGivenToWhatLiesThereAlone) {
  std::vector<StuffBelief> stuff{thing(1, -0.5, 0.2)};
  EXPECT_EQ(id_of({}, {{kFirst, 0.0}}), std::nullopt);
  EXPECT_EQ(id_of(stuff, {{kFirst, -0.5}}), std::nullopt);
  remember_name(stuff[0], thing(7, 0.0, 0.2));
  remember_name(stuff[0], thing(5, 0.25, 0.2));
  EXPECT_EQ(id_of(stuff, {{kFirst, 0.0}}), 7U);
  EXPECT_EQ(id_of(stuff, {{kFirst, 0.25}}), 5U);
  EXPECT_EQ(id_of(stuff, {{kFirst, -0.3}}), std::nullopt);
  // Behind where it was, and before.
  EXPECT_EQ(id_of(stuff, {{kFirst, 0.0, 0.0, 0.2, 0.2, 1.8}}), std::nullopt);
  EXPECT_EQ(id_of(stuff, {{kFirst, 0.0, 0.0, 0.2, 0.2, 1.3}}), std::nullopt);
  // As a small part of something larger.
  EXPECT_EQ(id_of(stuff, {{kFirst, -0.6, -0.4, 0.8, 0.6}}), std::nullopt);
}

TEST(JoinedNames, AreGivenToWhatShowsMostOfIt) {
  std::vector<StuffBelief> stuff{thing(1, -0.5, 0.2)};
  remember_name(stuff[0], thing(7, 0.0, 0.2));
  Board const less{kFirst, 0.0, 0.0, 0.08, 0.2};
  // The rest is hidden, or shows as another's.
  EXPECT_EQ(id_of(stuff, {less, {std::nullopt, 0.08, -0.1, 0.2, 0.4, 1.2}}), 7U);
  EXPECT_EQ(id_of(stuff, {less, {kSecond, 0.08, 0.0, 0.12, 0.2}}), std::nullopt);
}

TEST(JoinedNames, AreNotGivenInTheFrameThatTellsOfTheirEnd) {
  std::vector<StuffBelief> stuff{thing(1, -0.5, 0.2)};
  remember_name(stuff[0], thing(7, 0.0, 0.2));
  stuff[0].joined_ids = {7};
  EXPECT_EQ(id_of(stuff, {{kFirst, 0.0}}), std::nullopt);
}

TEST(JoinedNames, AreGivenOnceAndWithTheirHistory) {
  std::vector<StuffBelief> stuff{thing(1, -0.5, 0.2)};
  remember_name(stuff[0], thing(7, 0.0, 0.2));
  std::optional<JoinedThing> const old = taken(stuff, {{kFirst, 0.0}});
  ASSERT_TRUE(old);
  EXPECT_EQ(old->history_count, 7U);
  EXPECT_TRUE(stuff[0].names_kept.empty());
  EXPECT_EQ(id_of(stuff, {{kFirst, 0.0}}), std::nullopt);
}

// Where the thing stands anew is none of the places beside it.
TEST(JoinedNames, AreForgottenWhereTheThingMoves) {
  std::vector<StuffBelief> stuff{thing(1, -0.5, 0.2)};
  remember_name(stuff[0], thing(7, 0.0, 0.2));
  Segmentation const frame = test::segmentation_of({.boards = {{kFirst, 0.3}}});
  begin_model(stuff[0], clusters_of(frame).at(0));
  EXPECT_TRUE(stuff[0].names_kept.empty());
}

TEST(JoinedNames, AreFewAndOfFewPoints) {
  StuffBelief host = thing(1, 0.0, 0.3);
  for (std::uint32_t id = 2; id < 30; ++id) {
    StuffBelief joined = thing(id, 0.3, 2.0);
    remember_name(joined, thing(100 + id, 0.3, 0.2));
    remember_name(host, joined);
  }
  ASSERT_EQ(host.names_kept.size(), kMostNamesKept);
  EXPECT_EQ(host.names_kept.back().id, 29U);
  for (JoinedThing const& old : host.names_kept) {
    EXPECT_LE(old.points_world->size(), kMostPointsKept);
    EXPECT_GE(old.points_world->size(), kMostPointsKept / 4);
  }
}

}  // namespace
}  // namespace credo
