#include "geometry/icp.hpp"

#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "core/cloud.hpp"

namespace credo {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// An uneven surface patch of about 0.6 m.
Points surface(int points_a_side = 12) {
  Points points;
  for (int i = 0; i < points_a_side; ++i) {
    for (int j = 0; j < points_a_side; ++j) {
      float const x = 0.05F * static_cast<float>(i);
      float const y = 0.05F * static_cast<float>(j);
      points.emplace_back(x, y, 0.3F * x * y + 0.1F * std::sin(9.0F * x));
    }
  }
  return points;
}

Points moved(Se3 const& motion, Points points) {
  for (Eigen::Vector3f& p : points) {
    p = (motion * p.cast<double>()).cast<float>();
  }
  return points;
}

Se3 small_motion() {
  return {so3_exp({0.02, -0.01, 0.03}), {0.01, -0.008, 0.005}};
}

double motion_error(Se3 const& estimated, Se3 const& truth) {
  return boxminus(estimated, truth).norm();
}

TEST(AlignIcp, FindsAKnownMotion) {
  auto const alignment = align_icp(surface(), moved(small_motion(), surface()), {});
  ASSERT_TRUE(alignment);
  // Exact pairs leave rounding of the float coordinates.
  EXPECT_LT(motion_error(alignment->T_target_source, small_motion()), 1e-5);
  EXPECT_LT(alignment->rms_m, 1e-6);
}

TEST(AlignIcp, StaysWhereTheSetsAreTheSame) {
  auto const alignment = align_icp(surface(), surface(), {});
  ASSERT_TRUE(alignment);
  EXPECT_LT(motion_error(alignment->T_target_source, Se3()), 1e-6);
  EXPECT_EQ(alignment->iterations, 1);
}

TEST(AlignIcp, TellsSumAndRootMeanOfTheRemainingDistances) {
  // The middle of two pairs that do not fit: 0.1 m too near each other at either end.
  Points const source = {{0, 0, 0}, {1, 0, 0}};
  Points const target = {{-0.1F, 0, 0}, {1.1F, 0, 0}};
  auto const alignment = align_icp(source, target, {});
  ASSERT_TRUE(alignment);
  EXPECT_NEAR(alignment->sum_squared_m2, 0.02, 1e-6);
  EXPECT_NEAR(alignment->rms_m, 0.1, 1e-6);
}

TEST(AlignIcp, MovesASinglePointWithoutTurningIt) {
  auto const alignment = align_icp(Points{{1, 2, 3}}, Points{{1.1F, 2, 3}}, {});
  ASSERT_TRUE(alignment);
  EXPECT_LT(
      motion_error(alignment->T_target_source, Se3(Eigen::Quaterniond::Identity(), {0.1, 0, 0})),
      1e-6);
}

TEST(AlignIcp, PairsWithTheFirstOfEquallyNearPoints) {
  Points const source = {{0, 0, 0}};
  auto const right = align_icp(source, Points{{1, 0, 0}, {-1, 0, 0}}, {});
  auto const left = align_icp(source, Points{{-1, 0, 0}, {1, 0, 0}}, {});
  ASSERT_TRUE(right && left);
  EXPECT_EQ(right->T_target_source.translation(), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(left->T_target_source.translation(), Eigen::Vector3d(-1, 0, 0));
}

TEST(AlignIcp, TurnsPointsOnALineByTheLeastRotation) {
  Points source;
  for (int i = 0; i < 20; ++i) {
    source.emplace_back(0.1F * static_cast<float>(i), 0.0F, 0.0F);
  }
  Se3 const turn(so3_exp({0, 0, 0.02}), {0, 0, 0});
  auto const alignment = align_icp(source, moved(turn, source), {});
  ASSERT_TRUE(alignment);
  EXPECT_LT(motion_error(alignment->T_target_source, turn), 1e-5);
}

TEST(AlignIcp, GivesNothingForEmptySets) {
  EXPECT_FALSE(align_icp({}, surface(), {}));
  EXPECT_FALSE(align_icp(surface(), {}, {}));
  EXPECT_FALSE(align_icp(Points{{kNaN, 0, 0}}, surface(), {}));
}

TEST(AlignIcp, LeavesOutWhatIsNotFinite) {
  Points source = surface();
  source.insert(source.begin() + 3, {kNaN, 0, 0});
  Points target = moved(small_motion(), surface());
  target.insert(target.begin(), {0, kNaN, 0});
  auto const with = align_icp(source, target, {});
  auto const without = align_icp(surface(), moved(small_motion(), surface()), {});
  ASSERT_TRUE(with && without);
  EXPECT_EQ(with->T_target_source.matrix(), without->T_target_source.matrix());
  EXPECT_EQ(with->sum_squared_m2, without->sum_squared_m2);
}

TEST(AlignIcp, RefusesWhatIsBeyondItsLimits) {
  Points const target = moved(Se3(Eigen::Quaterniond::Identity(), {0.02, 0, 0}), surface());
  EXPECT_TRUE(align_icp(surface(), target, {.max_displacement_m = 0.021}));
  EXPECT_FALSE(align_icp(surface(), target, {.max_displacement_m = 0.019}));
  Points const source = {{0, 0, 0}, {1, 0, 0}};
  Points const stretched = {{-0.1F, 0, 0}, {1.1F, 0, 0}};
  EXPECT_TRUE(align_icp(source, stretched, {.max_rms_m = 0.101}));
  EXPECT_FALSE(align_icp(source, stretched, {.max_rms_m = 0.099}));
}

TEST(AlignIcp, RefusesEarlyOnlyWhatItWouldRefuseInTheEnd) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-0.3F, 0.3F);
  int accepted = 0;
  int refused = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Eigen::Vector3f const shift(coordinate(random), coordinate(random), coordinate(random));
    Points source;
    Points target;
    for (int i = 0; i < 30; ++i) {
      source.emplace_back(coordinate(random), coordinate(random), 0.2F * coordinate(random));
      target.emplace_back(source.back() + 0.5F * shift);
    }
    IcpConfig const limits{.max_rms_m = 0.04, .max_displacement_m = 0.15};
    auto const limited = align_icp(source, target, limits);
    auto const free = align_icp(source, target, {});
    ASSERT_TRUE(free);
    double longest_m = 0.0;
    for (Eigen::Vector3f const& p : source) {
      Eigen::Vector3d const from = p.cast<double>();
      longest_m = std::max(longest_m, (free->T_target_source * from - from).norm());
    }
    bool const within = free->rms_m <= limits.max_rms_m && longest_m <= limits.max_displacement_m;
    EXPECT_EQ(limited.has_value(), within) << trial;
    ++(within ? accepted : refused);
  }
  // Both must occur for the comparison to say something.
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 50);
}

TEST(AlignIcp, GivesTheSameBytesOnEveryInstructionSet) {
  Points source = surface(11);
  // Not a multiple of any vector, with ties.
  source.push_back(source.back());
  Points const target = moved(small_motion(), source);
  std::optional<IcpAlignment> first;
  for (std::int64_t const instructions : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(instructions);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    auto const alignment = align_icp(source, target, {});
    ASSERT_TRUE(alignment);
    first = first ? first : alignment;
    EXPECT_EQ(alignment->T_target_source.matrix(), first->T_target_source.matrix());
    EXPECT_EQ(alignment->sum_squared_m2, first->sum_squared_m2);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(AlignIcp, DoesNotDependOnWhereTheWorldIs) {
  Se3 const world(so3_exp({0.3, 0.5, -1.2}), {4, -3, 1});
  Points const target = moved(small_motion(), surface(9));
  auto const here = align_icp(surface(9), target, {});
  auto const there = align_icp(moved(world, surface(9)), moved(world, target), {});
  ASSERT_TRUE(here && there);
  EXPECT_LT(motion_error(there->T_target_source, world * here->T_target_source * world.inverse()),
            1e-4);
}

}  // namespace
}  // namespace credo
