#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "stages/fusion/fusion.hpp"
#include "stages/fusion/stuff/table_views.hpp"

// Known objects in hand-made frames with depth.
namespace credo::test {
namespace {

constexpr LabelCode kObject = kFirstObject;
/// Of the board that the box is, `left_m` to the right.
constexpr double kBox_m = 0.2;

KnownSurfaces const& surfaces() {
  static KnownSurfaces const known =
      known_surfaces({{"box",
                       {"box",
                        std::vector<Solid>{BoxSolid{{-kBox_m / 2, -kBox_m / 2, 0.0},
                                                    {kBox_m / 2, kBox_m / 2, 0.1}}},
                        {}}}});
  return known;
}

PoseDistribution pose_at(double left_m, double sigma_m) {
  PoseDistribution pose;
  pose.mean = Se3(Eigen::Quaterniond::Identity(), {left_m + kBox_m / 2, kBox_m / 2, 1.5});
  pose.covariance = Matrix6d::Identity() * sigma_m * sigma_m;
  return pose;
}

BeliefState told(std::vector<double> const& lefts_m) {
  BeliefState belief;
  for (double const left_m : lefts_m) {
    ObjectBelief& object = belief.objects.emplace_back();
    object.id = "box_" + std::to_string(belief.objects.size());
    object.type = "box";
    object.log_odds = log_odds_of(FusionConfig{}.prior_probability);
    object.pose_world = pose_at(left_m, 0.01);
    object.prior_covariance = object.pose_world.covariance;
  }
  return belief;
}

constexpr std::int64_t kTenth_ns = 100'000'000;

/// Frame `number` of ten a second.
View view_of(int number, std::vector<Board> boards) {
  return {.boards = std::move(boards), .stamp_ns = number * kTenth_ns};
}

Segmentation looked_for(View const& view, FrameIndex frame) {
  Segmentation segmentation = segmentation_of(view);
  segmentation.frame = frame;
  segmentation.objects_looked_for = true;
  return segmentation;
}

void find(Segmentation& segmentation, std::string const& id, double left_m) {
  ObjectObservation& seen = segmentation.objects.emplace_back();
  seen.object_id = id;
  seen.type = "box";
  seen.pixel_count = 400;
  seen.pose_world = pose_at(left_m, 0.005);
}

void refuse(Segmentation& segmentation, double left_m) {
  RefusedDetection& refused = segmentation.refused.emplace_back();
  refused.type = "box";
  refused.object_id = "box_1";
  refused.pose_world = pose_at(left_m, 0.005);
  refused.squared_distance = 1e3;
  refused.max_squared_distance = 22.0;
}

double probability(BeliefState const& belief, std::size_t object = 0) {
  return probability_of(belief.objects[object].log_odds);
}

TEST(KnownObjectsOverTime, WhatIsHiddenKeepsItsProbabilityToTheBit) {
  Board const in_front{std::nullopt, -0.5, -0.5, 1.0, 1.0, 1.0};
  BeliefState belief = told({0.0});
  ObjectBelief const before = belief.objects[0];
  for (int i = 0; i < 100; ++i) {
    belief = fuse(std::move(belief), looked_for(view_of(i, {{kObject}, in_front}), FrameIndex{i}),
                  {}, surfaces());
    EXPECT_EQ(belief.objects[0].evidence, Evidence::kOccluded);
    EXPECT_EQ(belief.objects[0].why.moved, 0.0);
  }
  EXPECT_EQ(belief.objects[0].log_odds, before.log_odds);
  EXPECT_EQ(belief.objects[0].pose_world.covariance, before.pose_world.covariance);
}

TEST(KnownObjectsOverTime, SoDoesWhatIsOutOfView) {
  BeliefState belief = told({5.0});
  double const before = belief.objects[0].log_odds;
  belief = fuse(std::move(belief), looked_for(view_of(0, {}), FrameIndex{0}), {}, surfaces());
  EXPECT_EQ(belief.objects[0].evidence, Evidence::kOutOfView);
  EXPECT_EQ(belief.objects[0].log_odds, before);
}

TEST(KnownObjectsOverTime, WhatIsSeenThroughGoesInAFewLooks) {
  BeliefState belief = told({0.0});
  belief = fuse(std::move(belief), looked_for(view_of(0, {}), FrameIndex{0}), {}, surfaces());
  EXPECT_EQ(belief.objects[0].evidence, Evidence::kSeenThrough);
  EXPECT_LT(belief.objects[0].why.moved, -4.0);
  EXPECT_LT(probability(belief), 0.5);
  for (int i = 1; i < 8; ++i) {
    belief = fuse(std::move(belief), looked_for(view_of(i, {}), FrameIndex{i}), {}, surfaces());
  }
  EXPECT_LT(probability(belief), 0.1);
}

// The detector erred: something with that very surface stands there.
TEST(KnownObjectsOverTime, WhatIsMissedButFitsTheDepthsStays) {
  BeliefState belief = told({0.0});
  for (int i = 0; i < 10; ++i) {
    belief =
        fuse(std::move(belief), looked_for(view_of(i, {{kObject}}), FrameIndex{i}), {}, surfaces());
  }
  EXPECT_GT(probability(belief), 0.9);
  EXPECT_EQ(belief.objects[0].evidence, Evidence::kNotSeen);
}

// Nothing says that it was moved: what is known of its pose stays known.
TEST(KnownObjectsOverTime, WhatFitsTheDepthsKeepsItsPose) {
  BeliefState belief = told({0.0});
  Segmentation seen = looked_for(view_of(0, {{kObject}}), FrameIndex{0});
  find(seen, "box_1", 0.0);
  belief = fuse(std::move(belief), seen, {}, surfaces());
  Matrix6d const known = belief.objects[0].pose_world.covariance;
  for (int i = 1; i < 50; ++i) {
    belief =
        fuse(std::move(belief), looked_for(view_of(i, {{kObject}}), FrameIndex{i}), {}, surfaces());
    EXPECT_EQ(belief.objects[0].evidence, Evidence::kNotSeen);
  }
  EXPECT_EQ(belief.objects[0].pose_world.covariance, known);
  for (int i = 50; i < 70; ++i) {
    belief = fuse(std::move(belief), looked_for(view_of(i, {}), FrameIndex{i}), {}, surfaces());
  }
  EXPECT_GT(belief.objects[0].pose_world.covariance.trace(), 1.5 * known.trace())
      << "one sees through it";
}

TEST(KnownObjectsOverTime, TheThesisForgetsEither) {
  FusionConfig config;
  config.visibility = false;
  BeliefState belief = told({5.0});
  for (int i = 0; i < 20; ++i) {
    belief = fuse(std::move(belief), looked_for(view_of(i, {}), FrameIndex{i}), config, surfaces());
  }
  EXPECT_LT(probability(belief), 0.1);
}

TEST(KnownObjectsOverTime, WhatIsFoundIsThere) {
  BeliefState belief = told({0.0});
  belief.objects[0].log_odds = -1.0;
  Segmentation frame = looked_for(view_of(0, {{kObject}}), FrameIndex{0});
  find(frame, "box_1", 0.0);
  belief = fuse(std::move(belief), frame, {}, surfaces());
  EXPECT_EQ(belief.objects[0].evidence, Evidence::kSeen);
  EXPECT_NEAR(belief.objects[0].log_odds, -1.0 + std::log(19.0), 1e-9);
  EXPECT_NEAR(belief.objects[0].why.moved, std::log(19.0), 1e-9);
  EXPECT_GT(belief.objects[0].why.visible_share, 0.8);
  EXPECT_FALSE(belief.objects[0].why.bounded);
}

TEST(KnownObjectsOverTime, TheBoundIsTold) {
  BeliefState belief = told({0.0});
  Segmentation frame = looked_for(view_of(0, {{kObject}}), FrameIndex{0});
  find(frame, "box_1", 0.0);
  belief = fuse(std::move(belief), frame, {}, surfaces());
  EXPECT_TRUE(belief.objects[0].why.bounded);
  EXPECT_EQ(belief.objects[0].log_odds, FusionConfig{}.existence.max_log_odds);
}

/// The box has gone from 0 and a detector that is right finds it at 0.4.
BeliefState moved(int frames) {
  BeliefState belief = told({0.0});
  for (int i = 0; i < frames; ++i) {
    Segmentation frame = looked_for(view_of(i, {{std::nullopt, 0.4}}), FrameIndex{i});
    if (belief.objects[0].pose_world.mean.translation().x() > 0.3) {
      find(frame, "box_1", 0.4);
    } else {
      refuse(frame, 0.4);
    }
    belief = fuse(std::move(belief), frame, {}, surfaces());
  }
  return belief;
}

TEST(KnownObjectsOverTime, WhatTurnsUpElsewhereHasMoved) {
  BeliefState const belief = moved(8);
  EXPECT_NEAR(belief.objects[0].pose_world.mean.translation().x(), 0.5, 1e-3);
  EXPECT_EQ(belief.objects[0].id, "box_1");
  EXPECT_GT(probability(belief), 0.5);
  EXPECT_FALSE(belief.objects[0].other_place.has_value());
}

TEST(KnownObjectsOverTime, NotAtTheFirstGlance) {
  BeliefState const belief = moved(1);
  EXPECT_NEAR(belief.objects[0].pose_world.mean.translation().x(), 0.1, 1e-9);
  ASSERT_TRUE(belief.objects[0].other_place.has_value());
}

// Its place is hidden: nothing says that it has gone, but there is only one of it.
TEST(KnownObjectsOverTime, WhatIsHiddenMovesAfterASecond) {
  Board const in_front{std::nullopt, -0.1, -0.1, 0.3, 0.3, 1.0};
  BeliefState belief = told({0.0});
  for (int i = 0; i < 30; ++i) {
    Segmentation frame = looked_for(view_of(i, {in_front, {std::nullopt, 0.4}}), FrameIndex{i});
    refuse(frame, 0.4);
    belief = fuse(std::move(belief), frame, {}, surfaces());
    if (i == 5) {
      EXPECT_NEAR(belief.objects[0].pose_world.mean.translation().x(), 0.1, 1e-9);
    } else if (i == 12) {
      EXPECT_NEAR(belief.objects[0].pose_world.mean.translation().x(), 0.5, 1e-3);
    }
  }
}

// What stands where it is found is that, or a thing of its own, not both.
TEST(KnownObjectsOverTime, WhereItMayStandNoThingIsAsSurelyBelieved) {
  Board const in_front{std::nullopt, -0.1, -0.1, 0.3, 0.3, 1.0};
  BeliefState belief = told({0.0});
  for (int i = 0; i < 7; ++i) {
    Segmentation frame = looked_for(view_of(i, {in_front, {kFirstStuff, 0.4}}), FrameIndex{i});
    refuse(frame, 0.4);
    belief = fuse(std::move(belief), frame, {}, surfaces());
    ASSERT_TRUE(belief.objects[0].other_place.has_value()) << i;
    ASSERT_EQ(belief.stuff.size(), 1U) << i;
    EXPECT_LE(belief.stuff[0].log_odds, -belief.objects[0].other_place->log_odds + 1e-12) << i;
  }
  for (int i = 7; i < 30; ++i) {
    Segmentation frame = looked_for(view_of(i, {in_front, {kFirstStuff, 0.4}}), FrameIndex{i});
    refuse(frame, 0.4);
    belief = fuse(std::move(belief), frame, {}, surfaces());
  }
  EXPECT_NEAR(belief.objects[0].pose_world.mean.translation().x(), 0.5, 1e-3);
}

// A detector that finds it now here, now there, is not believed.
TEST(KnownObjectsOverTime, FalseAlarmsDoNotMoveIt) {
  BeliefState belief = told({0.0});
  for (int i = 0; i < 30; ++i) {
    Segmentation frame = looked_for(view_of(i, {}), FrameIndex{i});
    refuse(frame, 0.3 + 0.2 * (i % 2));
    belief = fuse(std::move(belief), frame, {}, surfaces());
    EXPECT_LT(probability(belief), 0.5 + 0.5 * (i == 0 ? 1 : 0));
  }
}

// Two of a type: what was found stays, the other one is it.
TEST(KnownObjectsOverTime, WhatWasFoundIsNotMoved) {
  BeliefState belief = told({0.0, -0.5});
  for (int i = 0; i < 5; ++i) {
    Segmentation frame = looked_for(view_of(i, {{kObject}, {std::nullopt, 0.4}}), FrameIndex{i});
    find(frame, "box_1", 0.0);
    refuse(frame, 0.4);
    belief = fuse(std::move(belief), frame, {}, surfaces());
  }
  EXPECT_NEAR(belief.objects[0].pose_world.mean.translation().x(), 0.1, 1e-3);
  EXPECT_NEAR(belief.objects[1].pose_world.mean.translation().x(), 0.5, 1e-3);
}

// Refused because another detection fits better.
TEST(KnownObjectsOverTime, WhatIsAtAKnownObjectsPlaceIsNoOther) {
  BeliefState belief = told({0.0, -0.5});
  for (int i = 0; i < 5; ++i) {
    Segmentation frame = looked_for(view_of(i, {{kObject}}), FrameIndex{i});
    find(frame, "box_1", 0.0);
    refuse(frame, 0.02);
    frame.refused[0].squared_distance = 3.0;
    belief = fuse(std::move(belief), frame, {}, surfaces());
  }
  EXPECT_LT(probability(belief, 1), 0.5);
  EXPECT_FALSE(belief.objects[1].other_place.has_value());
}

}  // namespace
}  // namespace credo::test
