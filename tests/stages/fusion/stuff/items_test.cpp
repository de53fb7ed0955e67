#include "stages/fusion/stuff/items.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "stages/fusion/findings.hpp"
#include "stages/fusion/room.hpp"
#include "stages/fusion/stuff/table_views.hpp"

namespace credo {
namespace {

using test::Board;
using test::kFrame_ns;
using test::Room;
using test::View;

constexpr LabelCode kFirst = kFirstStuff;
constexpr LabelCode kSecond = kFirstStuff + 1;

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

TEST(StuffItems, WhatIsSeenFirstIsBelievedAtOnce) {
  Room room;
  room.show({.boards = {{kFirst}}});
  ASSERT_EQ(room.stuff().size(), 1U);
  EXPECT_EQ(room.stuff()[0].id, 1U);
  EXPECT_NEAR(probability_of(room.stuff()[0].log_odds), 0.7, 1e-12);
  EXPECT_EQ(room.stuff()[0].label, kFirst);
  EXPECT_EQ(room.stuff()[0].evidence, Evidence::kSeen);
  EXPECT_EQ(room.stuff()[0].history_count, 1U);
  // 20 x 20 pixels of a centimetre, 25 points across.
  EXPECT_NEAR(room.stuff()[0].model->spacing_m, 0.008, 1e-6);
  EXPECT_EQ(room.stuff()[0].latest().pixel_count, 400U);
}

TEST(StuffItems, SliversAreBelievedLessAtFirst) {
  auto const seen_first = [](double width_m) {
    Segmentation const frame = test::segmentation_of({.boards = {{kFirst, 0, 0, width_m, 0.4}}});
    return fused_items({}, frame, KnownPlaces({}, {}), 0.0, {}).stuff.at(0).log_odds;
  };
  BirthConfig const births;
  // 2 and 20 by 40 pixels of a centimetre: 4 area / outline.
  EXPECT_NEAR(seen_first(0.02), birth_log_odds(4.0 * 80 / 84, false, births, {}), 1e-9);
  EXPECT_NEAR(seen_first(0.2), birth_log_odds(4.0 * 800 / 120, false, births, {}), 1e-9);
  EXPECT_LT(seen_first(0.02), seen_first(0.2) - 1.0);
}

TEST(StuffItems, OfWhatIsSmallHalfTells) {
  auto const tells = [](int agreeing, double most_agreeing) {
    PointCounts look;
    look[PointState::kAgrees] = agreeing;
    return finding_of(look, most_agreeing, false).has_value();
  };
  EXPECT_TRUE(tells(6, 12.0));
  EXPECT_FALSE(tells(5, 12.0));
  EXPECT_TRUE(tells(8, 40.0));
  EXPECT_FALSE(tells(7, 40.0)) << "8 of what is larger";
}

// L + n log((1 - k + k .95) / (1 - k + k .05)) up to the bound, k = 1 - exp(-dt / 0.25 s).
TEST(StuffItems, ASensorThatStandsStillFollowsTheClosedForm) {
  Room room;
  room.show({.boards = {{kFirst}}});
  double const k = 1.0 - std::exp(-1e-9 * static_cast<double>(kFrame_ns) / 0.25);
  double const step = std::log((1.0 - k + k * 0.95) / (1.0 - k + k * 0.05));
  for (int n = 1; n <= 1800; ++n) {
    room.show({.boards = {{kFirst}}});
    ASSERT_NEAR(room.stuff()[0].log_odds, std::min(4.6, std::log(0.7 / 0.3) + n * step), 1e-9);
  }
  EXPECT_EQ(room.stuff().size(), 1U);
  EXPECT_EQ(room.stuff()[0].history_count, 1801U);
}

// However long it was seen: the log-odds are bounded.
TEST(StuffItems, WhatIsGoneIsRemovedAsSoonHoweverLongItWasSeen) {
  std::vector<int> looks;
  for (int const seen : {60, 600}) {
    Room room;
    room.show({.boards = {{kFirst}}}, seen);
    int frames = 0;
    for (; !room.stuff().empty() && frames < 300; ++frames) {
      room.show({});
      EXPECT_TRUE(room.stuff().empty() || room.stuff()[0].evidence == Evidence::kSeenThrough);
    }
    looks.push_back(frames);
  }
  EXPECT_EQ(looks[0], looks[1]);
  // One look in full, the rest of a second's worth of them.
  EXPECT_LE(looks[0], 15);
}

TEST(StuffItems, WhatIsNewHasMovedNothing) {
  Room room;
  room.show({.boards = {{kFirst}}});
  Account const& why = room.stuff()[0].why;
  EXPECT_EQ(why.moved, 0.0);
  EXPECT_EQ(why.news, 1.0);
  EXPECT_EQ(why.visible_share, 1.0);
  EXPECT_FALSE(why.bounded);
  EXPECT_EQ(why.points[PointState::kAgrees],
            static_cast<int>(room.stuff()[0].model->points.size()));
}

TEST(StuffItems, TheAccountTellsOfEveryPoint) {
  Room room;
  room.show({.boards = {{kFirst}}}, 5);
  auto const points = static_cast<int>(room.stuff()[0].model->points.size());
  double const news = 1.0 - std::exp(-1e-9 * static_cast<double>(kFrame_ns) / 0.25);
  EXPECT_EQ(room.stuff()[0].why.points[PointState::kAgrees], points);
  EXPECT_NEAR(room.stuff()[0].why.news, news, 1e-12);
  // As seen from the camera, three quarters of it are hidden.
  room.show({.boards = {{kFirst}, {kSecond, -0.1, -0.1, 0.2, 0.4, 1.0}}});
  Account const some = room.stuff()[0].why;
  EXPECT_NEAR(some.points[PointState::kOccluded], 3 * points / 4, points / 20);
  EXPECT_EQ(some.points[PointState::kAgrees] + some.points[PointState::kOccluded], points);
  EXPECT_NEAR(some.visible_share, some.points[PointState::kAgrees] / (0.8 * points), 1e-12);
  // Then all of it is seen through: news in full.
  room.show({});
  Account const through = room.stuff()[0].why;
  EXPECT_EQ(through.points[PointState::kSeenThrough], points);
  EXPECT_EQ(through.news, 1.0);
  EXPECT_LT(through.moved, -5.0);
}

// At the bound, what would move it on moves it less, and in the end not at all.
TEST(StuffItems, TheAccountTellsOfTheBound) {
  Room room;
  room.show({.boards = {{kFirst}}});
  while (room.stuff()[0].log_odds < 4.6) {
    EXPECT_FALSE(room.stuff()[0].why.bounded);
    room.show({.boards = {{kFirst}}});
  }
  EXPECT_TRUE(room.stuff()[0].why.bounded);
  EXPECT_GT(room.stuff()[0].why.moved, 0.0);
  room.show({.boards = {{kFirst}}});
  EXPECT_TRUE(room.stuff()[0].why.bounded);
  EXPECT_EQ(room.stuff()[0].why.moved, 0.0);
  EXPECT_GT(room.stuff()[0].why.news, 0.0);
}

struct Unseen {
  char const* name;
  View view;
  Evidence evidence;
  PointState points;
};

class NothingOfItIsSeen : public testing::TestWithParam<Unseen> {};

TEST_P(NothingOfItIsSeen, AndItsLogOddsStayToTheBit) {
  Room room;
  room.show({.boards = {{kFirst}}}, 5);
  double const before = room.stuff()[0].log_odds;
  for (int i = 0; i < 300; ++i) {
    room.show(GetParam().view);
    ASSERT_EQ(bits(room.stuff()[0].log_odds), bits(before));
    ASSERT_EQ(room.stuff()[0].evidence, GetParam().evidence);
    ASSERT_EQ(room.stuff()[0].label, std::nullopt);
    ASSERT_EQ(room.stuff()[0].why.moved, 0.0);
    ASSERT_EQ(room.stuff()[0].why.points[GetParam().points],
              static_cast<int>(room.stuff()[0].model->points.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ways, NothingOfItIsSeen,
    testing::Values(Unseen{"Hidden",
                           {.boards = {{kFirst}, {kSecond, -0.1, -0.1, 0.4, 0.4, 1.0}}},
                           Evidence::kOccluded,
                           PointState::kOccluded},
                    Unseen{"OutOfView", {.x_m = 2.0}, Evidence::kOutOfView, PointState::kOutOfView},
                    Unseen{
                        "NoDepth", {.blind_px = 120}, Evidence::kNotSeen, PointState::kUnmeasured}),
    [](auto const& instance) { return instance.param.name; });

TEST(StuffItems, WhatIsHalfHiddenIsStillSeen) {
  Room room;
  room.show({.boards = {{kFirst}}}, 5);
  double const before = room.stuff()[0].log_odds;
  room.show({.boards = {{kFirst}, {kSecond, 0.1, -0.1, 0.4, 0.4, 1.0}}});
  ASSERT_EQ(room.stuff().size(), 2U);
  EXPECT_EQ(room.stuff()[0].label, kFirst);
  EXPECT_GT(room.stuff()[0].log_odds, before);
}

TEST(StuffItems, AWallBehindThatIsSeenAgainTellsThatItHasGone) {
  Room room;
  room.show({.boards = {{kFirst}}}, 5);
  room.show({.boards = {{kSecond, -0.1, -0.1, 0.4, 0.4, 1.0}}}, 20);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({}, 20);
  EXPECT_TRUE(room.stuff().empty());
}

TEST(StuffItems, WhatAClusterIsTakenForHasNotGone) {
  Room room;
  room.show({.boards = {{kFirst}}}, 5);
  double const before = room.stuff()[0].log_odds;
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.06, 0.2}}});
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].evidence, Evidence::kSeen);
  EXPECT_GT(room.stuff()[0].log_odds, before);
}

/// Of the right half of a board 1.5 m away, the model's points there.
std::ptrdiff_t right_half(StuffBelief const& item) {
  return std::ranges::count_if(item.model->points, [](SurfacePoint const& point) {
    return point.p_world.x() > 0.12F && point.p_world.z() < 1.53F;
  });
}

// What is seen through is carved away, and more slowly where the thing itself is behind.
TEST(StuffItems, WhatIsSeenThroughIsCarvedAway) {
  Board const left{kFirst, 0.0, 0.0, 0.1, 0.2};
  Board const behind{kFirst, 0.1, 0.0, 0.1, 0.2, 1.6};
  for (auto const& [boards, stays] :
       {std::pair{std::vector<Board>{left}, false}, {std::vector<Board>{left, behind}, true}}) {
    Room room;
    room.show({.boards = {{kFirst}}}, 3);
    EXPECT_GT(right_half(room.stuff()[0]), 50);
    room.show({.boards = boards}, 40);
    EXPECT_EQ(right_half(room.stuff()[0]) > 50, stays);
  }
}

// Until it is plain that two things are one, neither takes the other's points.
TEST(StuffItems, WhatIsAnothersIsNotLearnt) {
  Room room;
  Board const left{kFirst, 0.0, 0.0, 0.12, 0.2};
  Board const right{kSecond, 0.12, 0.0, 0.08, 0.2};
  room.show({.boards = {left, right}}, 5);
  room.show({.boards = {{kFirst}}}, 5);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  EXPECT_LT(room.stuff()[0].latest().bounds_world.max().x(), 0.13F);
}

// A door, say, of which a strip at the image's edge is taken for its wall.
TEST(StuffItems, WhatIsHardlyInViewIsNotTakenForAWall) {
  Room room;
  Board door{kFirst, 0.0, 0.0, 0.6, 0.4};
  room.show({.boards = {door}}, 60);
  door.label = kFirstWall;
  // The view ends 0.8 m to the left of its middle: 9 cm of the door are in it.
  room.show({.boards = {door}, .x_m = 1.31}, 40);
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  room.show({.boards = {door}}, 50);
  EXPECT_TRUE(room.stuff().empty());
}

/// A thing at 1.5 m, and then 50 frames that call it floor, or a wall, in a plane that far away.
FusedStuff shown_as_known(LabelCode label, double plane_z_m) {
  FusedStuff stuff;
  for (int i = 0; i < 60; ++i) {
    bool const itself = i < 10;
    Segmentation frame =
        test::segmentation_of({.boards = {{itself ? kFirst : label}}, .stamp_ns = kFrame_ns * i});
    Plane const plane{-Eigen::Vector3d::UnitZ(), -plane_z_m};
    if (!itself && label == kFloor) {
      frame.floor.emplace().plane_world = plane;
    } else if (!itself) {
      frame.walls.emplace_back(WallObservation{label, plane, {}, 1});
    }
    stuff = fused_items(std::move(stuff), frame, KnownPlaces({}, {}), 1e-9 * kFrame_ns, {});
  }
  return stuff;
}

// A door in its wall, say, that a frame takes for that.
TEST(StuffItems, WhatShowsAsAPlaneButStandsBeforeItIsSeen) {
  for (LabelCode const label : {kFloor, kFirstWall}) {
    EXPECT_TRUE(shown_as_known(label, 1.5).stuff.empty());
    EXPECT_TRUE(shown_as_known(label, 1.515).stuff.empty()) << "noise";
    EXPECT_EQ(shown_as_known(label, 1.517).stuff.size(), 1U) << "so far off by noise is one pixel";
    EXPECT_TRUE(shown_as_known(label, 1.483).stuff.empty()) << "nothing stands behind a wall";
    FusedStuff const before_it = shown_as_known(label, 1.53);
    ASSERT_EQ(before_it.stuff.size(), 1U);
    EXPECT_EQ(before_it.stuff[0].evidence, Evidence::kSeen);
    EXPECT_GT(probability_of(before_it.stuff[0].log_odds), 0.95);
  }
}

TEST(StuffItems, WhatNothingExplainsStays) {
  Room room;
  room.show({.boards = {{kFirst}}}, 3);
  room.show({.boards = {{std::nullopt}}}, 60);
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U));
}

TEST(StuffItems, WhatIsMovedKeepsItsName) {
  Room room;
  Board const box{kFirst, 0.0, 0.0, 0.2, 0.3};
  Board const elsewhere{kFirst, 0.3, -0.1, 0.2, 0.3};
  room.show({.boards = {box}}, 30);
  room.show({.boards = {elsewhere}});
  ASSERT_THAT(room.ids(), testing::ElementsAre(1U));
  EXPECT_EQ(room.stuff()[0].label, kFirst);
  EXPECT_NEAR(room.stuff()[0].latest().centroid_world.x(), 0.4F, 0.01F);
  EXPECT_GE(probability_of(room.stuff()[0].log_odds), 0.7);
  EXPECT_EQ(room.stuff()[0].why.points[PointState::kAgrees], 0) << "where it was";
  EXPECT_GT(room.stuff()[0].why.points[PointState::kSeenThrough], 0);
}

TEST(StuffItems, AnotherThingElsewhereIsNew) {
  Room room;
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.2, 0.3}}}, 30);
  room.show({.boards = {{kFirst, 0.3, -0.1, 0.1, 0.1}}});
  EXPECT_THAT(room.ids(), testing::ElementsAre(1U, 2U));
  room.show({.boards = {{kFirst, 0.3, -0.1, 0.1, 0.1}}}, 30);
  EXPECT_THAT(room.ids(), testing::ElementsAre(2U));
}

// Three rows and four columns of pixels are a thing, one less is none.
TEST(StuffItems, WhatIsTooSmallIsNoThing) {
  Room room;
  room.show({.boards = {{kFirst, 0.0, 0.0, 0.04, 0.03}}});
  EXPECT_EQ(room.stuff().size(), 1U);
  Room other;
  other.show({.boards = {{kFirst, 0.0, 0.0, 0.03, 0.03}}});
  EXPECT_TRUE(other.stuff().empty());
}

TEST(StuffItems, ABoundOf0IsNone) {
  FusionConfig config;
  config.existence.max_log_odds = 0.0;
  StuffBelief item;
  item.log_odds = 4.0;
  believe(item, {Verdict::kSeen, 1.0}, {}, 1.0, config.existence);
  EXPECT_NEAR(item.log_odds, 4.0 + std::log(0.95 / 0.05), 1e-12);
}

TEST(StuffItems, WithoutASightNothingChanges) {
  Room room;
  FusedStuff const before = room.show({.boards = {{kFirst}}}, 3);
  Segmentation frame = test::segmentation_of({.boards = {{kFirst}}});
  frame.sight = {};
  FusedStuff const after = fused_items(before, frame, KnownPlaces({}, {}), 0.0, {});
  ASSERT_EQ(after.stuff.size(), 1U);
  EXPECT_EQ(bits(after.stuff[0].log_odds), bits(before.stuff[0].log_odds));
}

}  // namespace
}  // namespace credo
