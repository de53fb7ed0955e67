#include "stages/fusion/existence.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "stages/fusion/scenes.hpp"

namespace credo {
namespace {

using testing::AllOf;
using testing::Gt;
using testing::Lt;

double const kPrior = log_odds_of(0.99);

TEST(UpdatedLogOdds, IsBayesRuleWhereAFrameCountsInFull) {
  ExistenceConfig const config = test::thesis_config().existence;
  double const p = 0.7;
  double const seen = p * 0.95 / (p * 0.95 + (1 - p) * 0.05);
  double const missed = p * 0.05 / (p * 0.05 + (1 - p) * 0.95);
  EXPECT_NEAR(probability_of(
                  updated_log_odds(log_odds_of(p), Evidence::kSeen, Evidence::kSeen, 1.0, config)),
              seen, 1e-12);
  EXPECT_NEAR(probability_of(updated_log_odds(log_odds_of(p), Evidence::kSeen, Evidence::kNotSeen,
                                              1.0, config)),
              missed, 1e-12);
}

TEST(UpdatedLogOdds, IsBoundedBothWays) {
  ExistenceConfig const config;
  double up = 0.0;
  double down = 0.0;
  for (int i = 0; i < 1000; ++i) {
    up = updated_log_odds(up, Evidence::kSeen, Evidence::kSeen, 1.0, config);
    down = updated_log_odds(down, Evidence::kNotSeen, Evidence::kNotSeen, 1.0, config);
  }
  EXPECT_EQ(up, config.max_log_odds);
  EXPECT_EQ(down, -config.max_log_odds);
}

TEST(UpdatedLogOdds, CountsOnlyWhatIsNew) {
  ExistenceConfig const config;
  auto const missed = [&](double novelty) {
    return updated_log_odds(kPrior, Evidence::kNotSeen, Evidence::kNotSeen, novelty, config);
  };
  EXPECT_EQ(missed(0.0), kPrior);
  EXPECT_THAT(missed(0.5), AllOf(Lt(missed(0.1)), Gt(missed(1.0))));
}

TEST(UpdatedLogOdds, TakesAChangeInFull) {
  ExistenceConfig const config;
  EXPECT_NEAR(updated_log_odds(0.0, Evidence::kSeen, Evidence::kNotSeen, 0.1, config),
              -std::log(19.0), 1e-12);
  EXPECT_NEAR(updated_log_odds(0.0, Evidence::kOccluded, Evidence::kSeen, 0.1, config),
              std::log(19.0), 1e-12);
}

TEST(Novelty, IsFullWithoutAFrameBeforeAndInTheThesis) {
  EXPECT_EQ(novelty({}, {1, 0, 0}, {}), 1.0);
  ViewChange const still{0.0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  EXPECT_EQ(novelty(still, {1, 0, 0}, test::thesis_config().existence), 1.0);
}

TEST(Novelty, GrowsWithTimeAndWithTheTurnOfTheLineOfSight) {
  ExistenceConfig const config;
  Eigen::Vector3d const point(0, 0, 2);
  Eigen::Vector3d const here = Eigen::Vector3d::Zero();
  EXPECT_EQ(novelty({0.0, here, here}, point, config), 0.0);
  EXPECT_NEAR(novelty({0.25, here, here}, point, config), 1.0 - std::exp(-1.0), 1e-12);
  // Sideways by the tangent of the correlation angle.
  Eigen::Vector3d const aside(0.0, 2.0 * std::tan(config.correlation_angle_rad), 0.0);
  EXPECT_NEAR(novelty({0.0, here, aside}, point, config), 1.0 - std::exp(-1.0), 1e-12);
  // Straight towards it: the same side is seen.
  EXPECT_NEAR(novelty({0.0, here, {0, 0, 1}}, point, config), 0.0, 1e-12);
}

TEST(Novelty, IsDefinedWhereTheCameraStandsInTheThing) {
  EXPECT_EQ(novelty({0.0, Eigen::Vector3d(1, 1, 1), {1, 1, 1}}, {1, 1, 1}, {}), 0.0);
}

TEST(Novelty, MakesASecondOfFramesCountAsMuchAtAnyRate) {
  ExistenceConfig config;
  config.max_log_odds = 0.0;
  auto const after_a_second = [&](int frames) {
    ViewChange const still{1.0 / frames, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    double log_odds = 0.0;
    for (int i = 0; i < frames; ++i) {
      log_odds = updated_log_odds(log_odds, Evidence::kSeen, Evidence::kSeen,
                                  novelty(still, {1, 0, 0}, config), config);
    }
    return log_odds;
  };
  // Four correlation times: not the 88 that thirty looks would give.
  EXPECT_NEAR(after_a_second(30), after_a_second(60), 0.1);
  EXPECT_THAT(after_a_second(30), AllOf(Gt(3.0), Lt(4.0)));
}

TEST(ViewChange, TakesStampsThatRunBackwardsAsNoTime) {
  BeliefState belief;
  Segmentation segmentation = test::empty_segmentation(1);
  EXPECT_FALSE(view_change(belief, segmentation).camera_before_world);
  belief.frame = FrameIndex{0};
  EXPECT_NEAR(view_change(belief, segmentation).elapsed_s, 1.0 / 30, 1e-8);
  belief.stamp_ns = segmentation.stamp_ns + 1;
  EXPECT_EQ(view_change(belief, segmentation).elapsed_s, 0.0);
}

// P(look | there) = r / (1 + r), P(look | not there) = 1 / (1 + r): of 19 they are 0.95 and 0.05.
TEST(LogOddsStep, IsBayesRuleWithTheRatioOfBoth) {
  EXPECT_NEAR(log_odds_step(19.0, 1.0), std::log(19.0), 1e-12);
  EXPECT_NEAR(log_odds_step(1.0 / 19.0, 1.0), -std::log(19.0), 1e-12);
  EXPECT_EQ(log_odds_step(1.0, 0.3), 0.0);
  EXPECT_EQ(log_odds_step(19.0, 0.0), 0.0) << "no news";
  EXPECT_NEAR(log_odds_step(19.0, 0.2), std::log((0.8 + 0.2 * 0.95) / (0.8 + 0.2 * 0.05)), 1e-12);
}

TEST(AddStep, GivesAccountOfWhatItMovedWithinTheBound) {
  ExistenceConfig config;
  config.max_log_odds = 4.0;
  Account why;
  double log_odds = 3.0;
  add_step(log_odds, 0.5, why, config);
  EXPECT_EQ(log_odds, 3.5);
  EXPECT_EQ(why.moved, 0.5);
  EXPECT_FALSE(why.bounded);
  add_step(log_odds, 2.0, why, config);
  EXPECT_EQ(log_odds, 4.0);
  EXPECT_EQ(why.moved, 1.0) << "both together";
  EXPECT_TRUE(why.bounded);
}

TEST(BirthLogOdds, GrowWithTheLogarithmOfTheThickness) {
  BirthConfig const births{.log_odds = 1.0, .per_log_thickness = 2.0};
  ExistenceConfig const existence;
  EXPECT_NEAR(birth_log_odds(1.0, false, births, existence), 1.0, 1e-12);
  EXPECT_NEAR(birth_log_odds(2.0, false, births, existence), 1.0 + 2.0 * std::log(2.0), 1e-12);
  EXPECT_EQ(birth_log_odds(1e9, false, births, existence), existence.max_log_odds);
  EXPECT_NEAR(probability_of(birth_log_odds(1e9, true, births, existence)),
              births.arrived_probability, 1e-12);
  EXPECT_GT(probability_of(birth_log_odds(0.0, false, births, existence)),
            existence.min_probability)
      << "nothing is forgotten before it is looked at again";
}

}  // namespace
}  // namespace credo
