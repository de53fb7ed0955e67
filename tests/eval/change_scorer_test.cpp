// The mug (piece 7, label 4000), the box and the bottle appear, move and go; the belief notices
// sooner or later.
#include "eval/change_scorer.hpp"

#include <gtest/gtest.h>

#include "eval/perfect_run.hpp"

namespace credo::test {
namespace {

constexpr std::size_t kMug = 0;

/// From a frame on the mug is gone, truly and from the images.
void take_mug(std::vector<RunFrame>& run, std::size_t from) {
  for (std::size_t i = from; i < run.size(); ++i) {
    run[i].truth.stuff[kMug].present = false;
    fill(run[i].true_labels, square(2, 1), kFloor);
    fill(run[i].labels, square(2, 1), kFloor);
    run[i].belief.stuff[kMug].label.reset();
  }
  run[from].truth.events = {{"removed", "mug"}};
}

void drop_mug(std::vector<RunFrame>& run, std::size_t from) {
  for (std::size_t i = from; i < run.size(); ++i) {
    run[i].belief.stuff.erase(run[i].belief.stuff.begin());
  }
}

TEST(ChangeScorer, WhatIsRemovedIsNoticedWhenItIsNotBelievedAnyMore) {
  std::vector<RunFrame> run = perfect_run(8);
  take_mug(run, 3);
  run[4].belief.stuff[kMug].probability = 0.6;
  run[5].belief.stuff[kMug].probability = 0.4;
  drop_mug(run, 6);
  ChangeScores const scores = scores_of(run).change;
  EXPECT_EQ(scores.events, 1U);
  EXPECT_EQ(scores.recall, 1.0);
  EXPECT_EQ(scores.delay_frames, 2.0);
  EXPECT_EQ(scores.precision, 1.0) << "one claim, when it fell below a half";
}

TEST(ChangeScorer, WhatIsNeverNoticedIsMissed) {
  std::vector<RunFrame> run = perfect_run(8);
  take_mug(run, 3);
  ChangeScores const scores = scores_of(run).change;
  EXPECT_EQ(scores.recall, 0.0);
  EXPECT_FALSE(scores.delay_frames);
  EXPECT_FALSE(scores.precision);
}

TEST(ChangeScorer, ForgettingWhatIsThereIsAFalseClaim) {
  std::vector<RunFrame> run = perfect_run(4);
  drop_mug(run, 2);
  ChangeScores const scores = scores_of(run).change;
  EXPECT_EQ(scores.events, 0U);
  EXPECT_EQ(scores.precision, 0.0);
}

TEST(ChangeScorer, TradingOnePieceForAnotherOfTheSameThingIsNoClaim) {
  std::vector<RunFrame> run = perfect_run(4);
  for (std::size_t i = 2; i < run.size(); ++i) {
    run[i].belief.stuff[kMug].id = 30;
  }
  EXPECT_FALSE(scores_of(run).change.precision);
}

TEST(ChangeScorer, BecomingOneWithWhatIsBelievedIsNoClaimAndWithWhatIsNotIsOne) {
  for (double const probability_of_host : {0.9, 0.2}) {
    std::vector<RunFrame> run = perfect_run(4);
    drop_mug(run, 2);
    StuffSummary host;
    host.id = 40;
    host.probability = probability_of_host;
    host.joined_ids = {run[0].belief.stuff[kMug].id};
    run[2].belief.stuff.push_back(host);
    ChangeScores const scores = scores_of(run).change;
    if (probability_of_host > 0.5) {
      EXPECT_FALSE(scores.precision);
    } else {
      EXPECT_EQ(scores.precision, 0.0);
    }
  }
}

TEST(ChangeScorer, AMoveIsNoticedWhenTheNewPlaceIsBelievedAndTheOldIsNot) {
  std::vector<RunFrame> run = perfect_run(8);
  for (std::size_t i = 3; i < run.size(); ++i) {
    run[i].truth.stuff[kMug].pose = Se3(Eigen::Quaterniond::Identity(), {2, -0.8, 0.8});
    StuffSummary old = run[i].belief.stuff[kMug];
    old.label.reset();
    old.probability = i < 5 ? 0.8 : 0.3;
    run[i].belief.stuff[kMug].id = 30;  // the new place has a new piece
    run[i].belief.stuff.push_back(old);
  }
  run[3].truth.events = {{"moved", "mug"}};
  ChangeScores const scores = scores_of(run).change;
  EXPECT_EQ(scores.recall, 1.0);
  EXPECT_EQ(scores.delay_frames, 2.0);
  EXPECT_EQ(scores.precision, 1.0) << "the piece at the old place was dropped rightly";
}

TEST(ChangeScorer, APieceThatKeepsItsIdThroughAMoveNoticesAtOnce) {
  std::vector<RunFrame> run = perfect_run(6);
  for (std::size_t i = 3; i < run.size(); ++i) {
    run[i].truth.stuff[kMug].pose = Se3(Eigen::Quaterniond::Identity(), {2, -0.8, 0.8});
  }
  run[3].truth.events = {{"moved", "mug"}};
  EXPECT_EQ(scores_of(run).change.delay_frames, 0.0);
}

TEST(ChangeScorer, WhatAppearsIsNoticedWhenItIsBelieved) {
  std::vector<RunFrame> run = perfect_run(8);
  for (std::size_t i = 0; i < 3; ++i) {
    run[i].truth.stuff[kMug].present = false;
    fill(run[i].true_labels, square(2, 1), kFloor);
    fill(run[i].labels, square(2, 1), kFloor);
  }
  fill(run[3].labels, square(2, 1), kUnassigned);
  for (std::size_t i = 0; i < 4; ++i) {
    run[i].belief.stuff.erase(run[i].belief.stuff.begin());
  }
  run[3].truth.events = {{"appeared", "mug"}};
  ChangeScores const scores = scores_of(run).change;
  EXPECT_EQ(scores.events, 1U);
  EXPECT_EQ(scores.delay_frames, 1.0);
}

TEST(ChangeScorer, WhatNobodyCouldSeeDoesNotCount) {
  std::vector<RunFrame> run = perfect_run(6);
  for (RunFrame& frame : run) {
    frame.truth.stuff.push_back({"key", "", Se3{}, false, 0.0, 4002});
  }
  run[2].truth.events = {{"appeared", "key"}};  // behind something, for ever
  EXPECT_EQ(scores_of(run).change.events, 0U);
}

TEST(ChangeScorer, AKnownObjectThatMovesIsNoticedWhenItIsBelievedNearerToTheNewPlace) {
  std::vector<RunFrame> run = perfect_run(8);
  for (std::size_t i = 3; i < run.size(); ++i) {
    run[i].truth.objects[0].pose = Se3(Eigen::Quaterniond::Identity(), {2, 1.5, 0.8});
    run[i].belief.objects[0].position_m.y() = i < 6 ? 1.3 : 1.45;
  }
  run[3].truth.events = {{"moved", "the box"}};
  ChangeScores const scores = scores_of(run).change;
  EXPECT_EQ(scores.recall, 1.0);
  EXPECT_EQ(scores.delay_frames, 3.0);
}

TEST(ChangeScorer, AKnownObjectThatGoesAndComesBack) {
  std::vector<RunFrame> run = perfect_run(9);
  for (std::size_t i = 2; i < 9; ++i) {
    run[i].truth.objects[1].present = i >= 6;
    run[i].belief.objects[1].probability = i >= 3 && i < 8 ? 0.2 : 0.9;
  }
  run[2].truth.events = {{"removed", "the bottle"}};
  run[6].truth.events = {{"appeared", "the bottle"}};
  ChangeScores const scores = scores_of(run).change;
  EXPECT_EQ(scores.events, 2U);
  EXPECT_EQ(scores.recall, 1.0);
  EXPECT_EQ(scores.delay_frames, 1.5) << "the middle of 1 and 2";
  EXPECT_EQ(scores.precision, 1.0) << "gone, and there again";
}

TEST(ChangeScorer, ALostFrameHidesNoEvent) {
  std::vector<RunFrame> run = perfect_run(8);
  take_mug(run, 3);
  drop_mug(run, 5);
  Evaluation evaluation(room_models(), kRoomCamera);
  for (RunFrame const& frame : run) {
    bool const lost = frame.truth.frame == FrameIndex{3};
    evaluation.add(
        {frame.truth, lost ? nullptr : &frame.belief, &frame.labels, &frame.true_labels});
  }
  EXPECT_EQ(evaluation.scores().change.delay_frames, 2.0);
}

}  // namespace
}  // namespace credo::test
