#include "detector/poses/procrustes_refinement.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <thread>
#include <vector>

#include "detector/bpa/rendered_bracket.hpp"
#include "detector/search/global_search.hpp"
#include "geometry/random_draws.hpp"

namespace credo::test {
namespace {

constexpr std::size_t kPoints = 100;

Eigen::Vector3f drawn_vector(std::mt19937_64& random, double sigma) {
  Eigen::Vector3f drawn;
  for (float& value : drawn) {
    value = static_cast<float>(sigma * draw_normal(random));
  }
  return drawn;
}

/// Poses about the truth, and what becomes of them.
struct Trial {
  ScoredPose before;
  ScoredPose after;
};

class ProcrustesRefinement : public ::testing::Test {
protected:
  CameraPose truth = bracket_pose();
  SearchScene scene = scene_with_bracket(truth);
  PoseScore score{rendered_bracket(), scene};

  ScoredPose scored(CameraPose const& pose) const { return {pose, score(pose, kPoints)}; }
  ScoredPose refined_with(ScoredPose const& start, std::uint64_t seed) const {
    std::mt19937_64 random(seed);
    return procrustes_refined(rendered_bracket(), scene, score, start, kPoints, random);
  }
  std::vector<Trial> trials(int count, double shift_m, double turn_rad) const {
    std::mt19937_64 random(7);
    std::vector<Trial> trials;
    for (int i = 0; i < count; ++i) {
      CameraPose const start =
          moved_off(truth, drawn_vector(random, shift_m), drawn_vector(random, turn_rad));
      Trial trial;
      trial.before = scored(start);
      trial.after =
          procrustes_refined(rendered_bracket(), scene, score, trial.before, kPoints, random);
      trials.push_back(trial);
    }
    return trials;
  }
};

TEST_F(ProcrustesRefinement, NeverLowersTheScoreAndTellsThatOfThePose) {
  int bettered = 0;
  for (Trial const& trial : trials(60, 0.02, 0.3)) {
    EXPECT_GE(trial.after.score, trial.before.score);
    EXPECT_EQ(trial.after.score, score(trial.after.pose, kPoints));
    bettered += trial.after.score > trial.before.score ? 1 : 0;
  }
  EXPECT_GT(bettered, 40);
}

TEST_F(ProcrustesRefinement, DrawsPosesTowardsTheTruth) {
  double before_m = 0.0;
  double after_m = 0.0;
  for (Trial const& trial : trials(60, 0.008, 0.12)) {
    before_m += mean_apart_m(trial.before.pose, truth);
    after_m += mean_apart_m(trial.after.pose, truth);
  }
  EXPECT_LT(after_m, 0.75 * before_m) << before_m / 60.0 << " m before";
}

TEST_F(ProcrustesRefinement, IsTheSameForTheSameDrawsAndOtherForOthers) {
  ScoredPose const start = scored(moved_off(truth, {0.01F, 0.005F, 0.01F}, {0.1F, 0.1F, 0.0F}));
  ScoredPose const one = refined_with(start, 1);
  ScoredPose const again = refined_with(start, 1);
  ScoredPose const other = refined_with(start, 2);
  EXPECT_EQ(one.pose.rotation, again.pose.rotation);
  EXPECT_EQ(one.pose.translation_m, again.pose.translation_m);
  EXPECT_NE(one.pose.translation_m, other.pose.translation_m);
}

TEST_F(ProcrustesRefinement, LeavesAPoseThatFallsOnNothing) {
  // Into the wall, which is larger than the model.
  CameraPose const away = moved_off(truth, {0.3F, 0.0F, 0.7F}, Eigen::Vector3f::Zero());
  ScoredPose const start = scored(away);
  ScoredPose const after = refined_with(start, 1);
  EXPECT_EQ(after.pose.rotation, away.rotation);
  EXPECT_EQ(after.pose.translation_m, away.translation_m);
  EXPECT_EQ(after.score, start.score);
}

TEST_F(ProcrustesRefinement, MakesASearchThatIsTheSameOnAnyThread) {
  PairTable const pairs(rendered_bracket());
  std::vector<std::vector<PoseCandidate>> found(4);
  std::vector<std::thread> threads;
  for (std::vector<PoseCandidate>& own : found) {
    threads.emplace_back([&] { own = search_everywhere(rendered_bracket(), pairs, scene, 4); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  ASSERT_FALSE(found.front().empty());
  EXPECT_LT(mean_apart_m(found.front().front().pose, truth), 0.004);
  for (std::vector<PoseCandidate> const& own : found) {
    ASSERT_EQ(own.size(), found.front().size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_EQ(own[i].pose.rotation, found.front()[i].pose.rotation);
      EXPECT_EQ(own[i].pose.translation_m, found.front()[i].pose.translation_m);
    }
  }
}

}  // namespace
}  // namespace credo::test
