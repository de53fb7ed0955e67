#include "stages/fusion/objects/objects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "geometry/pose_fusion.hpp"
#include "stages/fusion/scenes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;
using testing::Eq;

constexpr double kNoise_m = 0.01;

BeliefState one_box() {
  BeliefState belief;
  ObjectBelief& object = belief.objects.emplace_back();
  object.id = "box_1";
  object.type = "box";
  object.log_odds = log_odds_of(FusionConfig{}.prior_probability);
  object.pose_world = {Se3(Eigen::Quaterniond::Identity(), {2, 0, 1}), Matrix6d::Identity() * 0.01};
  return belief;
}

/// A frame at 30 Hz from a place on a circle around the box; a step of 0 stands still.
Segmentation look(int number, bool seen, double step_rad) {
  Segmentation segmentation = empty_segmentation(number);
  double const angle = step_rad * number;
  segmentation.T_world_camera =
      Se3(Eigen::Quaterniond::Identity(), {2 + 2 * std::cos(angle), 2 * std::sin(angle), 1.5});
  segmentation.objects_looked_for = true;
  if (seen) {
    ObjectObservation& object = segmentation.objects.emplace_back();
    object.object_id = "box_1";
    object.pixel_count = 500;
    object.pose_world = {Se3(Eigen::Quaterniond::Identity(), {2.02, 0, 1}),
                         Matrix6d::Identity() * kNoise_m * kNoise_m};
  }
  return segmentation;
}

double probability(BeliefState const& belief) {
  return probability_of(belief.objects[0].log_odds);
}

TEST(FusedObjects, FadeAsTheThesisSays) {
  BeliefState belief = one_box();
  std::vector<double> history;
  for (int i = 0; i < 3; ++i) {
    belief = fuse(std::move(belief), look(i, false, 1.0), thesis_config());
    history.push_back(probability(belief));
  }
  EXPECT_NEAR(history[0], 0.839, 5e-4);
  EXPECT_NEAR(history[1], 0.215, 5e-4);
  EXPECT_NEAR(history[2], 0.014, 5e-4);
  EXPECT_EQ(belief.objects.size(), 1U) << "what was told is not forgotten";
}

TEST(FusedObjects, StayCertainWhileTheyAreSeen) {
  BeliefState belief = one_box();
  for (int i = 0; i < 3; ++i) {
    belief = fuse(std::move(belief), look(i, true, 1.0), thesis_config());
  }
  EXPECT_GE(probability(belief), 0.99);
  EXPECT_EQ(belief.objects[0].evidence, Evidence::kSeen);
}

TEST(FusedObjects, WhereNobodyLooksNothingMoves) {
  BeliefState const before = one_box();
  Segmentation blind = look(0, false, 1.0);
  blind.objects_looked_for = false;
  BeliefState const after = fuse(before, blind, {});
  EXPECT_EQ(after.objects[0].log_odds, before.objects[0].log_odds);
  EXPECT_EQ(after.objects[0].pose_world.covariance, before.objects[0].pose_world.covariance);
  EXPECT_EQ(after.objects[0].evidence, Evidence::kNotSeen);
}

TEST(FusedObjects, AMissLeavesThePoseAsItIs) {
  BeliefState const before = fuse(one_box(), look(0, true, 1.0), {});
  BeliefState const after = fuse(before, look(1, false, 1.0), {});
  EXPECT_EQ(after.objects[0].pose_world.covariance, before.objects[0].pose_world.covariance);
  EXPECT_EQ(after.objects[0].pose_world.mean.matrix(), before.objects[0].pose_world.mean.matrix());
  EXPECT_THAT(after.objects[0].label, Eq(std::nullopt));
}

TEST(FusedObjects, WithoutPixelsThereIsNoLabel) {
  Segmentation segmentation = look(0, true, 1.0);
  EXPECT_THAT(fuse(one_box(), segmentation, {}).objects[0].label, Eq(LabelCode{3000}));
  segmentation.objects[0].pixel_count = 0;
  BeliefState const belief = fuse(one_box(), segmentation, {});
  EXPECT_THAT(belief.objects[0].label, Eq(std::nullopt));
  EXPECT_EQ(belief.objects[0].evidence, Evidence::kSeen);
}

double deviation_after(int frames, double step_rad, FusionConfig const& config) {
  BeliefState belief = one_box();
  for (int i = 0; i < frames; ++i) {
    belief = fuse(std::move(belief), look(i, true, step_rad), config);
  }
  return std::sqrt(belief.objects[0].pose_world.covariance(0, 0));
}

// A second at 30 Hz: from one place it is a few looks, around the box it is thirty.
TEST(FusedObjects, StandingStillDoesNotAddUpToCertainty) {
  double const thirty = deviation_after(30, 0.0, thesis_config());
  EXPECT_NEAR(thirty, kNoise_m / std::sqrt(30.0), 1e-4) << "thesis: every frame counts in full";
  FusionConfig without_share;
  without_share.objects.min_covariance_share = 0.0;
  EXPECT_GT(deviation_after(30, 0.0, without_share), 2 * thirty);
  EXPECT_LT(deviation_after(30, 1.0, without_share), 1.05 * thirty);
}

// A minute from all sides, or an hour: what a detector's errors have in common stays.
TEST(FusedObjects, ThereIsAnEndToCertainty) {
  FusionConfig const config;
  double const least = kNoise_m * std::sqrt(config.objects.min_covariance_share);
  EXPECT_NEAR(deviation_after(300, 1.0, config), least, 1e-6);
  EXPECT_NEAR(deviation_after(3000, 0.0, config), least, 1e-4);
}

/// Mean squared Mahalanobis distance of the true pose after so many frames from one place, over 200
/// boxes, whose detections err as they tell, each by itself.
double mean_nees(int frames, bool errors_repeat) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, kNoise_m);
  Se3 const truth(Eigen::Quaterniond::Identity(), {2, 0, 1});
  double sum = 0.0;
  for (int box = 0; box < 200; ++box) {
    BeliefState belief = one_box();
    for (int i = 0; i < frames; ++i) {
      Segmentation segmentation = look(i, true, 0.0);
      Vector6d const error = Vector6d::NullaryExpr([&] { return normal(random); });
      segmentation.objects[0].pose_world.mean = boxplus(truth, error);
      segmentation.objects[0].errors_repeat = errors_repeat;
      belief = fuse(std::move(belief), segmentation, {});
    }
    PoseDistribution const& pose = belief.objects[0].pose_world;
    sum += match_pose(pose, {truth, Matrix6d::Zero()}, {}).squared_distance;
  }
  return sum / 200.0;
}

// 95 of 100 means of 200 honest claims lie between 5.5 and 6.5. Who does not know that errors are
// drawn anew has to claim less.
TEST(FusedObjects, ErrorsThatAreDrawnAnewAverageOut) {
  for (int const frames : {2, 30, 100}) {
    double const nees = mean_nees(frames, false);
    EXPECT_GT(nees, 5.5) << frames;
    EXPECT_LT(nees, 6.5) << frames;
  }
  EXPECT_LT(mean_nees(30, true), 3.0);
}

// A miss of what is believed in says little; what is believed to be gone may be anywhere within
// what was told.
TEST(FusedObjects, WhatIsGoneMayHaveBeenMoved) {
  BeliefState belief = one_box();
  Matrix6d const told = belief.objects[0].pose_world.covariance;
  belief.objects[0].prior_covariance = told;
  belief = fuse(std::move(belief), look(0, true, 1.0), {});
  Matrix6d const known = belief.objects[0].pose_world.covariance;
  BeliefState thesis = belief;
  auto const back = [&](BeliefState const& now) {
    return (now.objects[0].pose_world.covariance - known).trace() / (told - known).trace();
  };
  belief = fuse(std::move(belief), look(1, false, 1.0), {});
  EXPECT_LT(back(belief), 2e-3);
  for (int i = 2; i < 40; ++i) {
    belief = fuse(std::move(belief), look(i, false, 1.0), {});
    thesis = fuse(std::move(thesis), look(i, false, 1.0), thesis_config());
  }
  EXPECT_GT(back(belief), 0.95);
  EXPECT_LE(back(belief), 1.0);
  EXPECT_EQ(back(thesis), 0.0);
}

// What was not seen for a second is news when it is seen again, however often it flickers.
TEST(FusedObjects, NewsIsCountedFromTheLastSight) {
  BeliefState steady = one_box();
  BeliefState flickering = one_box();
  for (int i = 0; i <= 60; ++i) {
    steady = fuse(std::move(steady), look(i, true, 0.0), {});
    flickering = fuse(std::move(flickering), look(i, i % 2 == 0, 0.0), {});
  }
  double const often = steady.objects[0].pose_world.covariance(0, 0);
  double const seldom = flickering.objects[0].pose_world.covariance(0, 0);
  EXPECT_NEAR(seldom, often, 0.1 * often) << "the same two seconds from the same place";
}

TEST(FusedObjects, WhatStoodForAMinuteIsNotBelievedForAnother) {
  constexpr int kMinute = 1800;
  BeliefState belief = one_box();
  BeliefState thesis = one_box();
  for (int i = 0; i < kMinute; ++i) {
    belief = fuse(std::move(belief), look(i, true, 0.01), {});
    thesis = fuse(std::move(thesis), look(i, true, 0.01), thesis_config());
  }
  EXPECT_GE(probability(belief), 0.99);
  int misses = 0;
  while (probability(belief) > 0.5 && misses < kMinute) {
    belief = fuse(std::move(belief), look(kMinute + misses, false, 0.01), {});
    thesis = fuse(std::move(thesis), look(kMinute + misses, false, 0.01), thesis_config());
    ++misses;
  }
  EXPECT_LT(misses, 45) << "a second and a half";
  EXPECT_GT(probability(thesis), 0.99) << "and without a bound it is still believed";
}

}  // namespace
}  // namespace credo::test
