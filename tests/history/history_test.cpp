#include "history/history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "history/runs.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> names_of(std::vector<ThingHistory> const& histories) {
  std::vector<std::string> names;
  for (ThingHistory const& history : histories) {
    names.push_back(history.name);
  }
  return names;
}

TEST(History, HasAMomentForEachFrameThatBelievedTheThing) {
  std::vector<ThingHistory> const histories = histories_of(run_of_ten());
  ASSERT_EQ(histories.size(), 1U);
  ThingHistory const& history = histories[0];
  EXPECT_EQ(history.name, "stuff:7");
  EXPECT_EQ(history.kind, ThingKind::kStuff);
  ASSERT_EQ(history.moments.size(), 6U);
  Moment const& after_the_lost = history.moments[3];
  EXPECT_EQ(number(after_the_lost.at.frame), 6);
  EXPECT_EQ(after_the_lost.at.position, 5U) << "frame 5 did not come out";
  EXPECT_NEAR(after_the_lost.at.time_s, 0.6, 1e-12) << "since the first frame, not since 1970";
  EXPECT_EQ(after_the_lost.log_odds, 3.0);
  EXPECT_EQ(after_the_lost.probability, probability_of(3.0));
  EXPECT_EQ(after_the_lost.evidence, Evidence::kOccluded);
  ASSERT_TRUE(history.gone);
  EXPECT_EQ(number(history.gone->frame), 9);
  EXPECT_NEAR(history.gone->time_s, 0.9, 1e-12);
}

TEST(History, OfWhatBecameOneWithAnotherTellsWithWhich) {
  std::vector<BeliefSummary> run = run_of_ten();
  EXPECT_EQ(histories_of(run)[0].joined, "");
  StuffSummary host;
  host.id = 12;
  for (auto const& [joined_id, told] : {std::pair(7U, "stuff:12"), std::pair(8U, "")}) {
    auto const gone = std::ranges::find_if(
        run, [](BeliefSummary const& belief) { return number(belief.frame) == 9; });
    ASSERT_NE(gone, run.end());
    gone->stuff = {host};
    gone->stuff[0].joined_ids = {joined_id};
    EXPECT_EQ(histories_of(run)[0].joined, told);
  }
}

TEST(History, OfWhatIsBelievedToTheEndDoesNotEnd) {
  std::vector<BeliefSummary> run = run_of_ten();
  run.pop_back();
  EXPECT_FALSE(histories_of(run)[0].gone);
}

TEST(History, OfEveryKindOfThing) {
  std::vector<BeliefSummary> run = {empty_belief(0), empty_belief(1)};
  run[0].stuff = {stuff_at(3, 0.0, Evidence::kSeen, 0.0)};
  run[1].stuff = {stuff_at(1, 0.0, Evidence::kSeen, 0.0), stuff_at(3, 1.0, Evidence::kSeen, 1.0)};
  ObjectSummary object;
  object.id = "box_1";
  object.type = "box";
  object.log_odds = 2.0;
  run[0].objects = {object};
  WallSummary wall;
  wall.id = 2;
  wall.evidence = Evidence::kOutOfView;
  wall.why = Account();
  wall.why->moved = 0.25;
  run[1].walls = {wall};
  run[1].floor = FloorSummary();
  run[1].floor->probability = 0.9;
  std::vector<ThingHistory> const histories = histories_of(run);
  EXPECT_THAT(names_of(histories), ElementsAre("floor", "wall:2", "box_1", "stuff:3", "stuff:1"));
  EXPECT_EQ(histories[0].moments[0].probability, 0.9);
  EXPECT_EQ(histories[1].moments[0].why.moved, 0.25);
  EXPECT_EQ(histories[1].moments[0].evidence, Evidence::kOutOfView);
  EXPECT_EQ(histories[2].type, "box");
  EXPECT_EQ(histories[2].moments[0].log_odds, 2.0);
  EXPECT_TRUE(histories[2].gone);
  EXPECT_EQ(histories[3].moments.size(), 2U);
  EXPECT_TRUE(histories_of({}).empty());
}

TEST(History, ABeliefTellsWhyWhereAllItsThingsDo) {
  BeliefSummary belief = empty_belief(0);
  EXPECT_TRUE(tells_why(belief)) << "of nothing";
  belief.stuff = {stuff_at(3, 0.0, Evidence::kSeen, 0.0)};
  EXPECT_TRUE(tells_why(belief));
  for (int kind = 0; kind < 4; ++kind) {
    BeliefSummary untold = belief;
    if (kind == 0) {
      untold.floor = FloorSummary();
    } else if (kind == 1) {
      untold.walls.emplace_back();
    } else if (kind == 2) {
      untold.objects.emplace_back();
    } else {
      untold.stuff.emplace_back();
    }
    EXPECT_FALSE(tells_why(untold)) << kind;
  }
}

TEST(Spans, AreFramesOfOneEvidence) {
  ThingHistory const history = histories_of(run_of_ten())[0];
  std::vector<Span> const spans = spans_of(history);
  ASSERT_EQ(spans.size(), 3U);
  EXPECT_EQ(spans[0].begin, 0U);
  EXPECT_EQ(spans[0].end, 2U);
  EXPECT_EQ(spans[0].evidence, Evidence::kSeen);
  EXPECT_EQ(spans[0].log_odds_before, 1.0);
  EXPECT_EQ(spans[0].log_odds_after, 3.0);
  EXPECT_EQ(spans[0].moved, 2.0);
  EXPECT_EQ(spans[0].news, 0.5);
  EXPECT_EQ(spans[0].bounded, 1U);
  ASSERT_TRUE(spans[0].point_shares);
  EXPECT_NEAR(spans[0].point_shares->at(static_cast<std::size_t>(PointState::kAgrees)), 0.75, 1e-12)
      << "each frame counts alike: all of ten, half of forty";
  EXPECT_NEAR(spans[0].point_shares->at(static_cast<std::size_t>(PointState::kOccluded)), 0.25,
              1e-12);
  EXPECT_EQ(spans[1].begin, 2U);
  EXPECT_EQ(spans[1].end, 4U) << "a frame that was lost parts nothing";
  EXPECT_EQ(spans[1].evidence, Evidence::kOccluded);
  EXPECT_EQ(spans[1].log_odds_before, 3.0);
  EXPECT_EQ(spans[1].bounded, 0U);
  EXPECT_FALSE(spans[1].point_shares) << "nothing was told of any point";
  EXPECT_EQ(spans[2].log_odds_before, 3.0) << "before its first frame, not after";
  EXPECT_EQ(spans[2].log_odds_after, -1.0);
  EXPECT_EQ(spans[2].moved, -4.0);
  EXPECT_EQ(spans[2].news, 1.5);
}

TEST(Spans, EndWhereTheThingWasNotBelieved) {
  std::vector<BeliefSummary> run;
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    run.push_back(empty_belief(frame));
  }
  run[0].stuff = run[2].stuff = {stuff_at(1, 2.0, Evidence::kSeen, 0.0)};
  ThingHistory const history = histories_of(run)[0];
  EXPECT_EQ(spans_of(history).size(), 2U);
  EXPECT_FALSE(history.gone);
}

TEST(Account, TravelsUpAndDown) {
  EXPECT_EQ(travelled(histories_of(run_of_ten())[0]), 6.0);
}

TEST(Account, WhatItDoesNotExplainIsTold) {
  std::vector<BeliefSummary> run = run_of_ten();
  EXPECT_EQ(first_unaccounted(histories_of(run)[0]), std::nullopt);
  run[6].stuff[0].log_odds += 1e-10;
  EXPECT_EQ(first_unaccounted(histories_of(run)[0]), std::nullopt) << "rounding";
  run[6].stuff[0].log_odds += 1e-6;
  EXPECT_EQ(first_unaccounted(histories_of(run)[0]), 4U);
}

TEST(Evidence, HasWords) {
  EXPECT_EQ(evidence_text(Evidence::kSeenThrough), "seen through");
  EXPECT_EQ(evidence_text(Evidence::kOutOfView), "out of view");
}

}  // namespace
}  // namespace credo::test
