#include "eval/chance_scorer.hpp"

#include <gtest/gtest.h>

namespace credo {
namespace {

constexpr LabelCode kTrueMug = kFirstObject + 4;

/// A mug of 60 pixels.
LabelOverlap overlap() {
  LabelMap labels(40, 30, kFloor);
  for (int v = 10; v < 20; ++v) {
    for (int u = 5; u < 11; ++u) {
      labels[{u, v}] = kTrueMug;
    }
  }
  return {labels, labels};
}

FrameTruth truth() {
  FrameTruth truth;
  TrueThing& mug = truth.objects.emplace_back();
  mug.id = "mug";
  mug.type = "mug";
  mug.label = kTrueMug;
  return truth;
}

BeliefSummary belief(Evidence evidence) {
  BeliefSummary belief;
  belief.frame = FrameIndex{3};
  ObjectSummary& mug = belief.objects.emplace_back();
  mug.id = "mug_1";
  mug.type = "mug";
  mug.evidence = evidence;
  mug.why.emplace().visible_share = 0.4;
  return belief;
}

std::vector<Chance> chances(BeliefSummary const& belief, FrameTruth const& truth) {
  ChanceScorer scorer;
  scorer.add(belief, truth, {0}, {}, overlap());
  return scorer.chances();
}

TEST(ChanceScorer, TellsWhatOfAnObjectShowsAndWhetherItIsFound) {
  for (Evidence const evidence : {Evidence::kSeen, Evidence::kNotSeen, Evidence::kSeenThrough}) {
    std::vector<Chance> const found = chances(belief(evidence), truth());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].frame, FrameIndex{3});
    EXPECT_EQ(found[0].object_id, "mug_1");
    EXPECT_EQ(found[0].visible_share, 0.4);
    EXPECT_EQ(found[0].shown_px, 60U);
    EXPECT_EQ(found[0].is_found, evidence == Evidence::kSeen);
  }
}

TEST(ChanceScorer, WhatIsNotThereOrDoesNotShowIsNoChance) {
  FrameTruth gone = truth();
  gone.objects[0].present = false;
  EXPECT_TRUE(chances(belief(Evidence::kNotSeen), gone).empty());
  FrameTruth elsewhere = truth();
  elsewhere.objects[0].pose = Se3(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0});
  EXPECT_TRUE(chances(belief(Evidence::kSeen), elsewhere).empty());
  FrameTruth hidden = truth();
  hidden.objects[0].label = kTrueMug + 1;
  EXPECT_TRUE(chances(belief(Evidence::kNotSeen), hidden).empty());
}

TEST(ChanceScorer, NeedsToKnowWhichAndWhatOfItShows) {
  ChanceScorer scorer;
  scorer.add(belief(Evidence::kSeen), truth(), {std::nullopt}, {}, overlap());
  BeliefSummary old = belief(Evidence::kSeen);
  old.objects[0].why.reset();
  scorer.add(old, truth(), {0}, {}, overlap());
  EXPECT_TRUE(scorer.chances().empty());
}

}  // namespace
}  // namespace credo
