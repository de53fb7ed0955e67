#include "graph/belief_trail.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace credo {
namespace {

BeliefPtr some_belief() {
  return std::make_shared<BeliefState const>();
}

TEST(BeliefTrail, IsThePriorBeforeTheFirstFrame) {
  BeliefPtr const prior = some_belief();
  BeliefTrail const trail(prior, 2);
  EXPECT_EQ(trail.newest(), prior);
  EXPECT_EQ(trail.after(kPriorFrame), prior);
  EXPECT_EQ(trail.after(FrameIndex{-2}), prior);
  EXPECT_TRUE(trail.counted(kPriorFrame));
  EXPECT_FALSE(trail.counted(FrameIndex{0}));
}

TEST(BeliefTrail, RemembersAsFarBackAsTheLag) {
  BeliefPtr const prior = some_belief();
  BeliefTrail trail(prior, 2);
  BeliefPtr const beliefs[] = {some_belief(), some_belief(), some_belief(), some_belief()};
  for (int i = 0; i < 4; ++i) {
    trail.count(FrameIndex{i}, beliefs[i]);
  }
  EXPECT_EQ(trail.newest(), beliefs[3]);
  EXPECT_EQ(trail.after(FrameIndex{3}), beliefs[3]);
  EXPECT_EQ(trail.after(FrameIndex{1}), beliefs[1]);
  EXPECT_THROW((void)trail.after(FrameIndex{0}), std::logic_error);
  EXPECT_THROW((void)trail.after(FrameIndex{4}), std::logic_error);
}

TEST(BeliefTrail, ALostFrameLeavesTheBeliefAsItWas) {
  BeliefTrail trail(some_belief(), 3);
  BeliefPtr const first = some_belief();
  trail.count(FrameIndex{0}, first);
  trail.count_lost_until(FrameIndex{2});
  trail.count_lost_until(FrameIndex{1});  // counted already
  EXPECT_EQ(trail.after(FrameIndex{1}), first);
  EXPECT_EQ(trail.after(FrameIndex{2}), first);
  EXPECT_FALSE(trail.counted(FrameIndex{3}));
}

TEST(BeliefTrail, RefusesAFrameOutOfTurn) {
  BeliefTrail trail(some_belief(), 1);
  EXPECT_THROW(trail.count(FrameIndex{1}, some_belief()), std::logic_error);
}

}  // namespace
}  // namespace credo
