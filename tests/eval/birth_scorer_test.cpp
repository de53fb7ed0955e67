#include "eval/birth_scorer.hpp"

#include <gtest/gtest.h>

namespace credo {
namespace {

constexpr LabelCode kTrueBox = kFirstStuff + 7;
constexpr LabelCode kTrueWall = kFirstWall;

/// 160 pixels in a row are 160 blocks: a square of 20 and a strip of 2 by 40.
LabelMap labels() {
  LabelMap map(160, 120, kFloor);
  for (int v = 10; v < 30; ++v) {
    for (int u = 10; u < 30; ++u) {
      map[{u, v}] = kFirstStuff;
    }
  }
  for (int v = 50; v < 90; ++v) {
    map[{100, v}] = kFirstStuff + 1;
    map[{101, v}] = kFirstStuff + 1;
  }
  return map;
}

LabelMap true_labels() {
  LabelMap map = labels();
  for (LabelCode& label : map) {
    label = label == kFirstStuff ? kTrueBox : label == kFirstStuff + 1 ? kTrueWall : label;
  }
  return map;
}

BeliefSummary belief_with(std::vector<std::pair<std::uint32_t, LabelCode>> const& pieces) {
  BeliefSummary belief;
  belief.frame = FrameIndex{3};
  for (auto const& [id, label] : pieces) {
    StuffSummary& piece = belief.stuff.emplace_back();
    piece.id = id;
    piece.label = label;
  }
  return belief;
}

TEST(BirthScorer, TellsOfEachPieceOnceHowThickItIsAndWhetherItIsAThing) {
  FrameTruth truth;
  truth.frame = FrameIndex{3};
  TrueThing& box = truth.stuff.emplace_back();
  box.id = "box";
  box.label = kTrueBox;
  BeliefSummary const belief = belief_with({{5, kFirstStuff}, {6, kFirstStuff + 1}});
  ToldObjects const told(belief, truth);
  StuffBodies bodies;
  bodies.update(belief, truth, LabelOverlap(labels(), true_labels()));
  BirthScorer scorer;
  scorer.add(belief, labels(), bodies, truth, told);
  scorer.add(belief, labels(), bodies, truth, told);
  ASSERT_EQ(scorer.births().size(), 2U);
  EXPECT_EQ(scorer.births()[0].stuff_id, 5U);
  EXPECT_EQ(scorer.births()[0].frame, FrameIndex{3});
  EXPECT_DOUBLE_EQ(scorer.births()[0].thickness_blocks, 20.0);
  EXPECT_TRUE(scorer.births()[0].is_there);
  EXPECT_DOUBLE_EQ(scorer.births()[1].thickness_blocks, 4.0 * 80 / 84);
  EXPECT_FALSE(scorer.births()[1].is_there) << "a strip of wall";
}

TEST(BirthScorer, WhatIsNotInTheImageTellsNothing) {
  FrameTruth const truth;
  BeliefSummary belief = belief_with({{5, kFirstStuff + 9}});
  belief.stuff.emplace_back();
  BirthScorer scorer;
  scorer.add(belief, labels(), {}, truth, ToldObjects(belief, truth));
  EXPECT_TRUE(scorer.births().empty());
}

}  // namespace
}  // namespace credo
