#include "eval/wall_scorer.hpp"

#include <gtest/gtest.h>

#include "eval/perfect_run.hpp"

namespace credo::test {
namespace {

WallScores scores_with(std::vector<WallSummary> const& walls) {
  RunFrame frame = perfect_run(1).front();
  frame.belief.walls = walls;
  WallScorer scorer;
  scorer.see(frame.truth, frame.true_labels, kRoomCamera);
  scorer.add(frame.belief, frame.truth);
  return scorer.scores();
}

WallSummary wall(Eigen::Vector2d const& start_m, Eigen::Vector2d const& end_m) {
  WallSummary result;
  result.segment_start_m = start_m;
  result.segment_end_m = end_m;
  Eigen::Vector2d const along = (end_m - start_m).normalized();
  result.normal = {-along.y(), along.x(), 0.0};
  return result;
}

TEST(WallScorer, EndsAreMeasuredAgainstWhatWasSeen) {
  WallScores const scores = scores_with({wall({4, 3.6}, {4, -3.8})});
  EXPECT_EQ(scores.precision, 1.0);
  EXPECT_EQ(scores.recall, 1.0);
  EXPECT_NEAR(*scores.endpoint_m, 0.5 * (0.3 + 0.1), 1e-9) << "seen from -3.9 to 3.9 m";
}

TEST(WallScorer, OneWallInTwoPiecesIsOneTooMany) {
  WallScores const scores = scores_with({wall({4, -3.9}, {4, 1}), wall({4, 1.2}, {4, 3.9})});
  EXPECT_EQ(scores.precision, 0.5);
  EXPECT_EQ(scores.recall, 1.0);
  EXPECT_NEAR(*scores.endpoint_m, 0.5 * (0.0 + 2.9), 1e-9) << "of the longer";
}

TEST(WallScorer, OffBesideOrTiltedIsNoSuchWall) {
  EXPECT_EQ(scores_with({wall({3.8, -3.9}, {3.8, 3.9})}).precision, 0.0);
  EXPECT_EQ(scores_with({wall({4, 4.5}, {4, 9.0})}).precision, 0.0) << "never seen there";
  EXPECT_EQ(scores_with({wall({3.0, -3.9}, {5.0, 3.9})}).precision, 0.0);
  EXPECT_EQ(scores_with({}).recall, 0.0);
  EXPECT_FALSE(scores_with({}).precision);
}

TEST(WallScorer, AWallIsRightWhereItWasSeenThoughTheCameraIsBehindItNow) {
  RunFrame frame = perfect_run(1).front();
  frame.belief.walls = {wall({4, -3.9}, {4, 3.9})};
  WallScorer scorer;
  scorer.see(frame.truth, frame.true_labels, kRoomCamera);
  FrameTruth behind = frame.truth;
  TrueWall& other_face = behind.walls.front();
  other_face.segment_start_m.x() += 0.12;
  other_face.segment_end_m.x() += 0.12;
  other_face.normal = -other_face.normal;
  scorer.add(frame.belief, behind);
  EXPECT_EQ(scorer.scores().precision, 1.0);
  EXPECT_EQ(scorer.scores().recall, 1.0);
}

TEST(WallScorer, AWallThatHardlyShowsIsNotToBeFound) {
  RunFrame frame = perfect_run(1).front();
  frame.belief.walls.clear();
  LabelMap few(40, 30, kFloor);
  few[{3, 3}] = kFirstWall;
  WallScorer scorer;
  scorer.see(frame.truth, few, kRoomCamera);
  scorer.add(frame.belief, frame.truth);
  EXPECT_FALSE(scorer.scores().recall);
  scorer.see(frame.truth, frame.true_labels, kRoomCamera);
  scorer.add(frame.belief, frame.truth);
  EXPECT_EQ(scorer.scores().recall, 0.0);
}

}  // namespace
}  // namespace credo::test
