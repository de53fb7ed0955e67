#include "eval/detection_scorer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/solid.hpp"

namespace credo::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A box without symmetry, one that looks the same after half a turn about z, and a round can.
TrueModels models() {
  TrueModels result;
  auto const add = [&](std::string const& name, Solid const& solid, Symmetry const& symmetry) {
    result.emplace(name, TrueModel({name, std::vector<Solid>{solid}, symmetry}));
  };
  add("box", box_on_base({0.1, 0.2, 0.3}), {});
  add("brick", box_on_base({0.1, 0.2, 0.3}), {std::nullopt, {rotation_of_rpy_deg({0, 0, 180})}});
  add("can", CylinderSolid{0.04, 0.12}, {SymmetryAxis{}, {}});
  return result;
}

Detection detection(std::string const& type, Se3 const& pose, double score = 1.0) {
  return {type, {pose, 1e-4 * Matrix6d::Identity()}, score, 1.0};
}

Se3 pose(double x_m, double turn_deg = 0.0,
         Eigen::Vector3d const& axis = Eigen::Vector3d::UnitX()) {
  return {so3_exp(turn_deg * kDegree * axis), {x_m, 0, 1}};
}

TEST(DetectionScorer, EachTierHasItsOwnLimits) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  // Right to all tiers; to the wider two; to the widest; to none, for its place or for its turn.
  scorer.add({detection("box", pose(0.014, 14.9))}, {{"box", pose(0)}});
  scorer.add({detection("box", pose(0.016, 0))}, {{"box", pose(0)}});
  scorer.add({detection("box", pose(0, 44.9))}, {{"box", pose(0)}});
  scorer.add({detection("box", pose(0.051, 0))}, {{"box", pose(0)}});
  scorer.add({detection("box", pose(0, 45.1))}, {{"box", pose(0)}});
  DetectionScores const scores = scorer.scores();
  EXPECT_EQ(scores.tiers[0].right, 3U);
  EXPECT_EQ(scores.tiers[1].right, 2U);
  EXPECT_EQ(scores.tiers[2].right, 1U);
  EXPECT_EQ(scores.tiers[0].detections, 5U);
  EXPECT_EQ(scores.tiers[0].truths, 5U);
  EXPECT_DOUBLE_EQ(scores.tiers[2].precision.value, 0.2);
}

TEST(DetectionScorer, PrecisionRecallAndF1ByHand) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  // One right, one of the wrong model, one where nothing is; one not found, one hidden.
  scorer.add({detection("box", pose(0)), detection("brick", pose(0)), detection("can", pose(2))},
             {{"box", pose(0)}, {"can", pose(0.5)}, {"brick", pose(1), 0.05}});
  TierScores const tier = scorer.scores().tiers[0];
  EXPECT_DOUBLE_EQ(tier.precision.value, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(tier.recall.value, 0.5);
  EXPECT_DOUBLE_EQ(tier.f1.value, 0.4);
}

/// Detections of a scene with a chance of being right that grows with their score.
std::vector<Detection> guesses(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<Detection> told;
  for (int place = 0; place < 12; ++place) {
    double const score = std::round(20.0 * any(random)) / 20.0;
    bool const right = any(random) < 0.75 + 0.5 * score;
    told.push_back(detection("box", pose(right ? place : place + 0.3), score));
  }
  return told;
}

TEST(DetectionScorer, WhatIsFoundAtAPrecisionIsWhatIsFoundWithoutLowerScores) {
  TrueModels const known = models();
  std::mt19937_64 random(7);
  int from_the_middle = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<TrueInstance> truths;
    for (int place = 0; place < 12; ++place) {
      truths.push_back({"box", pose(place), place % 4 == 0 ? 0.05 : 0.25 * (place % 4)});
    }
    std::vector<std::vector<Detection>> const scenes = {guesses(random), guesses(random)};
    auto const scored_from = [&](double from_score) {
      DetectionScorer scorer(known);
      for (std::vector<Detection> told : scenes) {
        std::erase_if(told, [&](Detection const& d) { return d.score < from_score; });
        scorer.add(told, truths);
      }
      return scorer.scores();
    };
    // The obvious way: all thresholds, from above.
    std::optional<TierScores> expected;
    for (int step = 20; step >= 0; --step) {
      TierScores const tier = scored_from(step / 20.0).tiers[1];
      if (tier.detections > 0 && tier.precision.value >= kComparedAtPrecision) {
        expected = tier;
      }
    }
    auto const at = scored_from(0.0).at_precision[1];
    ASSERT_EQ(at.has_value(), expected.has_value());
    if (at) {
      from_the_middle += at->from_score > 0.0 ? 1 : 0;
      EXPECT_EQ(at->scores.right, expected->right);
      EXPECT_EQ(at->scores.detections, expected->detections);
      EXPECT_EQ(at->scores.recall.low, expected->recall.low);
      EXPECT_EQ(at->scores.band_recall[0].value, expected->band_recall[0].value);
      EXPECT_EQ(at->scores.band_recall[1].value, expected->band_recall[1].value);
    }
  }
  EXPECT_GT(from_the_middle, 5) << "or the scenes tell nothing";
}

TEST(DetectionScorer, WhereNoScoreIsPreciseNothingIsFoundAtAPrecision) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  EXPECT_FALSE(scorer.scores().at_precision[0]) << "of no scene";
  scorer.add({detection("box", pose(1), 0.9), detection("box", pose(0), 0.8)}, {{"box", pose(0)}});
  EXPECT_FALSE(scorer.scores().at_precision[0]) << "half of them are wrong, and the best";
}

TEST(DetectionScorer, WhatIsHardlySeenCountsNeitherWay) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  scorer.add({detection("box", pose(0)), detection("can", pose(1))},
             {{"box", pose(0), 0.099}, {"can", pose(1), 0.1}});
  TierScores const tier = scorer.scores().tiers[0];
  EXPECT_EQ(tier.detections, 1U);
  EXPECT_EQ(tier.truths, 1U);
  EXPECT_EQ(tier.right, 1U);
}

TEST(DetectionScorer, OneDetectionIsOfOneObjectAndTheHighestScoreGoesFirst) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  scorer.add({detection("box", pose(0.01), 0.5), detection("box", pose(0.02), 0.9),
              detection("box", pose(0.03), 0.7)},
             {{"box", pose(0)}});
  EXPECT_FALSE(scorer.last_matches()[0][0]);
  EXPECT_EQ(scorer.last_matches()[1][0], 0U);
  EXPECT_EQ(scorer.last_matches()[0][2], 0U) << "the one that is right to the narrow tier";
  EXPECT_EQ(scorer.scores().tiers[0].right, 1U);
  // Of two objects the nearer, and each once.
  scorer.add({detection("box", pose(0.03)), detection("box", pose(0.035))},
             {{"box", pose(0)}, {"box", pose(0.04)}});
  EXPECT_EQ(scorer.last_matches()[0][0], 1U);
  EXPECT_EQ(scorer.last_matches()[1][0], 0U);
  scorer.add({detection("box", pose(0.01))}, {{"box", pose(0)}, {"box", pose(0.04)}});
  EXPECT_EQ(scorer.last_matches()[0][0], 0U) << "the nearer, though it is the first";
}

TEST(DetectionScorer, SymmetryIsNoError) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  scorer.add({detection("brick", pose(0, 180, Eigen::Vector3d::UnitZ())),
              detection("can", pose(1, 77, Eigen::Vector3d::UnitZ())),
              detection("box", pose(2, 180, Eigen::Vector3d::UnitZ()))},
             {{"brick", pose(0)}, {"can", pose(1)}, {"box", pose(2)}});
  EXPECT_TRUE(scorer.last_matches()[0][2]);
  EXPECT_TRUE(scorer.last_matches()[1][2]);
  EXPECT_FALSE(scorer.last_matches()[2][0]);
  DetectionScores const scores = scorer.scores();
  EXPECT_DOUBLE_EQ(scores.add_recall, 2.0 / 3.0) << "the box's points are all elsewhere";
  EXPECT_DOUBLE_EQ(scores.add_s_recall, 1.0) << "its surface is where it was";
  EXPECT_EQ(scores.nees_6.count, 1U);
  EXPECT_EQ(scores.nees_5.count, 1U);
}

TEST(DetectionScorer, RecallByVisibility) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  scorer.add({detection("box", pose(0)), detection("brick", pose(1))},
             {{"box", pose(0), 0.71}, {"brick", pose(1), 0.7}, {"can", pose(2), 0.4}});
  scorer.add({}, {{"box", pose(0), 0.41}, {"can", pose(2), 0.15}});
  TierScores const tier = scorer.scores().tiers[0];
  EXPECT_EQ(tier.band_truths[0], 1U);
  EXPECT_EQ(tier.band_truths[1], 2U);
  EXPECT_EQ(tier.band_truths[2], 1U);
  EXPECT_DOUBLE_EQ(tier.band_recall[0].value, 1.0);
  EXPECT_DOUBLE_EQ(tier.band_recall[1].value, 0.5);
  EXPECT_DOUBLE_EQ(tier.band_recall[2].value, 0.0);
}

TEST(DetectionScorer, IntervalsAreThoseOfDrawnScenes) {
  TrueModels const known = models();
  DetectionScorer even(known);
  DetectionScorer uneven(known);
  for (int i = 0; i < 40; ++i) {
    bool const found = i % 4 != 0;
    even.add({detection("box", pose(0))}, {{"box", pose(0)}});
    uneven.add({detection("box", pose(found ? 0 : 1))}, {{"box", pose(0)}});
  }
  EXPECT_EQ(even.scores().tiers[0].recall.low, 1.0);
  EXPECT_EQ(even.scores().tiers[0].recall.high, 1.0);
  ScoredShare const recall = uneven.scores().tiers[0].recall;
  EXPECT_DOUBLE_EQ(recall.value, 0.75);
  // Of a share of 0.75 in 40 the standard deviation is 0.068.
  EXPECT_NEAR(recall.low, 0.75 - 1.96 * 0.0685, 0.03);
  EXPECT_NEAR(recall.high, 0.75 + 1.96 * 0.0685, 0.03);
  EXPECT_EQ(recall.low, uneven.scores().tiers[0].recall.low) << "the same each time";
}

TEST(DetectionScorer, HonestCovariancesLieWithinTheBounds) {
  TrueModels const known = models();
  DetectionScorer honest(known);
  DetectionScorer too_sure(known);
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    for (char const* name : {"box", "can"}) {
      Vector6d error;
      for (double& value : error) {
        value = 0.005 * normal(random);
      }
      Detection found = detection(name, boxplus(pose(0), error));
      found.pose_camera.covariance = 0.005 * 0.005 * Matrix6d::Identity();
      honest.add({found}, {{name, pose(0)}});
      found.pose_camera.covariance /= 4.0;
      too_sure.add({found}, {{name, pose(0)}});
    }
  }
  DetectionScores const good = honest.scores();
  EXPECT_EQ(good.nees_6.count, 200U);
  EXPECT_EQ(good.nees_5.count, 200U);
  for (NeesScores const& nees : {good.nees_6, good.nees_5}) {
    EXPECT_GT(nees.mean, nees.low_bound);
    EXPECT_LT(nees.mean, nees.high_bound);
    EXPECT_NEAR(nees.coverage, 0.95, 0.04);
  }
  // Tables: chi-square of 1200 degrees of freedom, 2.5 and 97.5 %, over 200.
  EXPECT_NEAR(good.nees_6.low_bound, 5.530, 0.002);
  EXPECT_NEAR(good.nees_6.high_bound, 6.489, 0.002);
  EXPECT_NEAR(too_sure.scores().nees_6.mean, 4.0 * good.nees_6.mean, 1e-6);
}

TEST(DetectionScorer, TheBoundOfWhatIsToBeFoundCountsForDistancesToo) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  scorer.add({detection("box", pose(0)), detection("can", pose(1))},
             {{"box", pose(0), 0.1}, {"can", pose(1), 0.09}});
  EXPECT_DOUBLE_EQ(scorer.scores().add_recall, 1.0);
  // The box's diameter is 37 cm: 3.6 cm are near enough, 3.9 are not.
  DetectionScorer near(known);
  near.add({detection("box", pose(0.036)), detection("box", pose(1.039))},
           {{"box", pose(0)}, {"box", pose(1)}});
  EXPECT_DOUBLE_EQ(near.scores().add_recall, 0.5);
}

TEST(DetectionScorer, NeesIsOfAllThatIsRightToTheWideTier) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  // Errors of 1, 3 and 4 cm where one centimetre is told; the last two are right to wide alone.
  scorer.add({detection("box", pose(0.01))}, {{"box", pose(0)}});
  scorer.add({detection("box", pose(0.03))}, {{"box", pose(0)}});
  scorer.add({detection("box", pose(0.04))}, {{"box", pose(0)}});
  NeesScores const nees = scorer.scores().nees_6;
  EXPECT_EQ(nees.count, 3U);
  EXPECT_NEAR(nees.mean, (1.0 + 9.0 + 16.0) / 3.0, 1e-6);
  EXPECT_NEAR(nees.median, 9.0, 1e-6);
  // 95 % of chi-square of 6 degrees of freedom are below 12.59.
  EXPECT_NEAR(nees.coverage, 2.0 / 3.0, 1e-9);
}

TEST(DetectionScorer, TheLimitOfCoverageIsThatOfItsDegreesOfFreedom) {
  TrueModels const known = models();
  // Squares of 12.3 and 11.2: within 12.59 (6) and beyond 11.07 (5), both beyond their 90 %.
  DetectionScorer scorer(known);
  scorer.add({detection("box", pose(0.01 * std::sqrt(12.3)))}, {{"box", pose(0)}});
  scorer.add({detection("can", pose(0.01 * std::sqrt(11.2)))}, {{"can", pose(0)}});
  EXPECT_EQ(scorer.scores().nees_6.coverage, 1.0);
  EXPECT_EQ(scorer.scores().nees_5.coverage, 0.0);
}

TEST(DetectionScorer, NothingAtAll) {
  TrueModels const known = models();
  DetectionScorer scorer(known);
  EXPECT_TRUE(std::isnan(scorer.scores().tiers[0].recall.value));
  scorer.add({}, {});
  EXPECT_TRUE(std::isnan(scorer.scores().tiers[0].precision.value));
  EXPECT_EQ(scorer.scores().nees_6.count, 0U);
  EXPECT_THROW(scorer.add({detection("lamp", pose(0))}, {}), std::logic_error);
}

}  // namespace
}  // namespace credo::test
