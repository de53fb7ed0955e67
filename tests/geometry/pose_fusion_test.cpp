#include "geometry/pose_fusion.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace credo::test {
namespace {

using Eigen::Vector3d;

Vector6d deviations(double position_m, double rotation_rad) {
  Vector6d sigma;
  sigma << Vector3d::Constant(position_m), Vector3d::Constant(rotation_rad);
  return sigma;
}

PoseDistribution about(Se3 const& mean, Vector6d const& sigma) {
  return {mean, sigma.cwiseAbs2().asDiagonal()};
}

Vector6d drawn(std::mt19937& generator, Vector6d const& sigma) {
  std::normal_distribution<double> normal;
  Vector6d error;
  for (Eigen::Index i = 0; i < 6; ++i) {
    error[i] = sigma[i] * normal(generator);
  }
  return error;
}

Se3 const kPose(so3_exp({0.3, -0.5, 1.1}), {1.0, -2.0, 0.7});
SymmetryAxis const kAxis{Vector3d(1, 2, 2) / 3.0, {0.05, -0.02, 0.1}};

Se3 turned_about(Se3 const& pose, SymmetryAxis const& axis, double angle_rad) {
  Eigen::Quaterniond const turn = so3_exp(angle_rad * axis.direction);
  return pose * Se3(turn, axis.point_m - turn * axis.point_m);
}

TEST(MatchPose, IsThePlainMahalanobisDistanceWithoutSymmetry) {
  Vector6d error;
  error << 0.02, -0.01, 0.03, 0, 0, 0;
  PoseMatch const match = match_pose(about(kPose, deviations(0.03, 0.1)),
                                     about(boxplus(kPose, error), deviations(0.04, 0.05)), {});
  EXPECT_NEAR(match.squared_distance, error.squaredNorm() / (0.05 * 0.05), 1e-9);
  EXPECT_EQ(match.degrees_of_freedom, 6);
  error << 0, 0, 0, 0.01, 0.02, -0.005;
  EXPECT_NEAR(match_pose(about(kPose, deviations(0.03, 0.1)),
                         about(boxplus(kPose, error), deviations(0.04, 0.05)), {})
                  .squared_distance,
              error.squaredNorm() / (0.01 + 0.0025), 1e-9);
}

TEST(MatchPose, TurnsAboutTheAxisCostNothing) {
  PoseDistribution const expected = about(kPose, deviations(0.03, 0.1));
  Symmetry const symmetry{kAxis, {}};
  Vector6d error;
  error << 0.02, -0.01, 0.03, 0.05, -0.02, 0.01;
  Se3 const found = boxplus(kPose, error);
  double const still =
      match_pose(expected, about(found, deviations(0.01, 0.02)), symmetry).squared_distance;
  EXPECT_GT(still, 0.1);
  for (double const angle : {-3.0, -1.0, 0.4, 2.0, 3.1}) {
    // Isotropic covariance about a far origin turns with the pose: about the axis it looks alike.
    Se3 const other = turned_about(found, kAxis, angle);
    PoseMatch const match = match_pose(expected, about(other, deviations(0.01, 0.02)), symmetry);
    EXPECT_EQ(match.degrees_of_freedom, 5);
    EXPECT_NEAR(match.squared_distance, still, 0.06 * still) << angle;
  }
}

TEST(MatchPose, TakesTheNearestOfTheTurns) {
  Symmetry const symmetry{{}, {rotation_of_rpy_deg({0, 0, 180}), rotation_of_rpy_deg({180, 0, 0})}};
  PoseDistribution const expected = about(kPose, deviations(0.03, 0.1));
  Vector6d error;
  error << 0.01, 0, 0, 0, 0.03, 0;
  Se3 const found = boxplus(kPose, error);
  double const plain =
      match_pose(expected, about(found, deviations(0.01, 0.02)), {}).squared_distance;
  for (Eigen::Quaterniond const& turn : symmetry.rotations) {
    Se3 const other = found * Se3(turn, Vector3d::Zero());
    PoseMatch const match = match_pose(expected, about(other, deviations(0.01, 0.02)), symmetry);
    EXPECT_NEAR(match.squared_distance, plain, 1e-9);
    EXPECT_GT(match_pose(expected, about(other, deviations(0.01, 0.02)), {}).squared_distance, 100);
  }
}

TEST(MatchPose, BothWaysTakesTheNearerEnd) {
  SymmetryAxis axis = kAxis;
  axis.both_ways = true;
  Symmetry const symmetry{axis, {}};
  PoseDistribution const expected = about(kPose, deviations(0.03, 0.1));
  Vector6d error;
  error << 0.01, 0, 0, 0, 0.03, 0;
  Se3 const found = boxplus(kPose, error);
  Vector6d const noise = deviations(0.01, 0.02);
  double const plain = match_pose(expected, about(found, noise), {kAxis, {}}).squared_distance;
  // About the axis' point, so that the covariance of the found pose's origin is no other.
  Se3 const other = found * end_for_end(axis);
  PoseMatch const match = match_pose(expected, about(other, noise), symmetry);
  EXPECT_NEAR(match.squared_distance, plain, 0.1 * plain);
  EXPECT_EQ(match.degrees_of_freedom, 5);
  EXPECT_GT(match_pose(expected, about(other, noise), {kAxis, {}}).squared_distance, 100);
  PoseDistribution const fused = updated_pose(expected, about(other, noise), symmetry, {});
  EXPECT_LT((fused.mean.rotation() * axis.direction - kPose.rotation() * axis.direction).norm(),
            0.1)
      << "it keeps its way up";
}

TEST(MatchPose, FollowsTheChiSquareDistribution) {
  std::mt19937 generator(3);
  Vector6d sigma;
  sigma << 0.02, 0.05, 0.03, 0.04, 0.02, 0.03;
  Vector6d const noise = deviations(0.01, 0.02);
  for (bool const round : {false, true}) {
    Symmetry const symmetry = round ? Symmetry{kAxis, {}} : Symmetry{};
    double sum = 0;
    constexpr int kRuns = 4000;
    for (int i = 0; i < kRuns; ++i) {
      Se3 const mean = boxplus(kPose, drawn(generator, sigma));
      Se3 found = boxplus(kPose, drawn(generator, noise));
      if (round) {
        found = turned_about(found, kAxis, 0.01 * i);
      }
      sum += match_pose(about(mean, sigma), about(found, noise), symmetry).squared_distance;
    }
    double const expected = round ? 5 : 6;
    // Three standard errors of the mean, and a little for what is not linear.
    EXPECT_NEAR(sum / kRuns, expected, 3 * std::sqrt(2 * expected / kRuns) + 0.05);
  }
}

// A sharp and a vague prior are equally far: the detection is likelier to be of the sharp one.
TEST(MatchPose, TellsTheVolumeOfItsCovariance) {
  Vector6d const noise = deviations(0.02, 0.03);
  Matrix6d const sum =
      about(kPose, deviations(0.03, 0.04)).covariance + about(kPose, noise).covariance;
  PoseMatch const plain = match_pose(about(kPose, deviations(0.03, 0.04)), about(kPose, noise), {});
  EXPECT_NEAR(plain.log_determinant, std::log(sum.determinant()), 1e-9);
  // About an axis through the origin: the rest is five dimensions, one turn less.
  Symmetry const symmetry{SymmetryAxis{kAxis.direction, Vector3d::Zero()}, {}};
  PoseMatch const round =
      match_pose(about(kPose, deviations(0.03, 0.04)), about(kPose, noise), symmetry);
  EXPECT_NEAR(round.log_determinant, plain.log_determinant - std::log(0.05 * 0.05), 1e-9);
}

TEST(MatchPose, RefusesCovariancesThatAreNone) {
  PoseDistribution const flat{kPose, Matrix6d::Zero()};
  EXPECT_THROW((void)match_pose(flat, flat, {}), std::logic_error);
}

TEST(UpdatedPose, IsTheWeightedMeanOfPositions) {
  Vector6d error = Vector6d::Zero();
  error.head<3>() << 0.1, -0.2, 0.05;
  PoseDistribution const after = updated_pose(
      about(kPose, deviations(0.03, 0.1)), about(boxplus(kPose, error), deviations(0.04, 0.1)), {});
  double const gain = 0.03 * 0.03 / (0.03 * 0.03 + 0.04 * 0.04);
  EXPECT_NEAR((boxminus(after.mean, kPose) - gain * error).norm(), 0, 1e-9);
  Matrix6d expected = Matrix6d::Identity() * (0.01 / 2);
  expected.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() * (0.03 * 0.03 * (1 - gain));
  EXPECT_NEAR((after.covariance - expected).norm(), 0, 1e-9);
}

TEST(UpdatedPose, ASharpDetectionIsTakenAsItIs) {
  Vector6d error;
  error << 0.1, -0.2, 0.05, 0.4, -0.3, 0.2;
  PoseDistribution detected = about(boxplus(kPose, error), deviations(1e-3, 2e-3));
  detected.covariance(0, 4) = detected.covariance(4, 0) = 1e-6;
  PoseDistribution const after = updated_pose(about(kPose, deviations(1, 1)), detected, {});
  EXPECT_NEAR(boxminus(after.mean, detected.mean).norm(), 0, 1e-4);
  EXPECT_NEAR((after.covariance - detected.covariance).norm(), 0,
              1e-3 * detected.covariance.norm());
}

TEST(UpdatedPose, HalfTheWeightIsHalfTheInformation) {
  PoseDistribution const expected = about(kPose, deviations(10, 3));
  PoseDistribution const detected = about(kPose, deviations(0.01, 0.02));
  PoseDistribution const after = updated_pose(expected, detected, {}, {.weight = 0.5});
  EXPECT_NEAR((after.covariance - 2 * detected.covariance).norm(), 0,
              1e-3 * detected.covariance.norm());
  for (PoseUpdate const& bad :
       {PoseUpdate{.weight = 0.0}, PoseUpdate{.weight = 1.5},
        PoseUpdate{.min_covariance_share = 0.6}, PoseUpdate{.min_covariance_share = -0.1}}) {
    EXPECT_THROW((void)updated_pose(expected, detected, {}, bad), std::logic_error);
  }
}

TEST(UpdatedPose, RigidMotionOfEverythingChangesNothing) {
  Se3 const motion(so3_exp({1.0, 0.4, -2.0}), {5, 6, -7});
  std::mt19937 generator(4);
  for (bool const round : {false, true}) {
    Symmetry const symmetry = round ? Symmetry{kAxis, {}} : Symmetry{};
    Vector6d sigma;
    sigma << 0.02, 0.05, 0.03, 0.04, 0.02, 0.03;
    PoseDistribution const expected = about(kPose, sigma);
    PoseDistribution const detected =
        about(boxplus(kPose, drawn(generator, sigma)), deviations(0.01, 0.02));
    PoseDistribution const here = transformed(motion, updated_pose(expected, detected, symmetry));
    PoseDistribution const there =
        updated_pose(transformed(motion, expected), transformed(motion, detected), symmetry);
    EXPECT_NEAR(boxminus(there.mean, here.mean).norm(), 0, 1e-9);
    EXPECT_NEAR((there.covariance - here.covariance).norm(), 0, 1e-12);
  }
}

/// Variance of the turn about the axis, all else being known.
double unseen_information(PoseDistribution const& pose, SymmetryAxis const& axis) {
  Vector3d const direction = pose.mean.rotation() * axis.direction;
  Vector3d const arm = pose.mean.rotation() * axis.point_m;
  Vector6d turn;
  turn << -direction.cross(arm), direction;  // moves the origin, not the axis' point
  return turn.dot(pose.covariance.inverse() * turn);
}

TEST(UpdatedPose, NothingIsEverLearntAboutATurnThatCannotBeSeen) {
  std::mt19937 generator(5);
  Symmetry const symmetry{kAxis, {}};
  Vector6d sigma;
  sigma << 0.02, 0.05, 0.03, 0.1, 0.2, 0.15;
  PoseDistribution pose = about(boxplus(kPose, drawn(generator, sigma)), sigma);
  double const before = unseen_information(pose, kAxis);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  for (int look = 0; look < 2000; ++look) {
    Se3 const found = turned_about(boxplus(kPose, drawn(generator, deviations(0.01, 0.03))), kAxis,
                                   any(generator));
    pose = updated_pose(pose, about(found, deviations(0.01, 0.03)), symmetry);
  }
  EXPECT_NEAR(unseen_information(pose, kAxis), before, 1e-6 * before);
  Vector3d const axis_error =
      (pose.mean.rotation() * kAxis.direction).cross(kPose.rotation() * kAxis.direction);
  EXPECT_LT(axis_error.norm(), 0.004) << "its direction is well known";
  EXPECT_LT((pose.mean * kAxis.point_m - kPose * kAxis.point_m).norm(), 0.002);
}

// A tenth of a radian about the axis, beside which the origin stands: the surface does not move.
TEST(LargestDeviation, LeavesOutTurnsThatCannotBeSeen) {
  Vector6d sigma;
  sigma << 0.01, 0.01, 0.01, 0.02, 0.02, 0.02;
  PoseDistribution pose = about(kPose, sigma);
  double const before_m = largest_deviation_m(pose, 0.3, Symmetry{kAxis, {}});
  Vector3d const direction = kPose.rotation() * kAxis.direction;
  Vector6d turn;
  turn << -direction.cross(kPose.rotation() * kAxis.point_m), direction;
  pose.covariance += 0.01 * turn * turn.transpose();
  EXPECT_NEAR(largest_deviation_m(pose, 0.3, Symmetry{kAxis, {}}), before_m, 1e-12);
  EXPECT_GT(largest_deviation_m(pose, 0.3, {}), 0.02);
  EXPECT_NEAR(before_m, std::hypot(0.01, 0.02 * 0.3), 0.005);
}

/// Mean of the squared normalised error of so many runs: the prior's mean is drawn from the prior,
/// then come the looks.
double mean_nees(std::mt19937& generator, Vector6d const& sigma, Vector6d const& noise, int looks,
                 int runs, Symmetry const& symmetry) {
  double sum = 0;
  for (int run = 0; run < runs; ++run) {
    PoseDistribution pose = about(boxplus(kPose, drawn(generator, sigma)), sigma);
    for (int look = 0; look < looks; ++look) {
      pose = updated_pose(pose, about(boxplus(kPose, drawn(generator, noise)), noise), symmetry);
    }
    // The truth, with a covariance that adds next to nothing.
    sum += match_pose(pose, about(kPose, deviations(1e-6, 1e-6)), symmetry).squared_distance;
  }
  return sum / runs;
}

TEST(UpdatedPose, ErrorAndCovarianceAgree) {
  std::mt19937 generator(6);
  Vector6d sigma;
  sigma << 0.05, 0.03, 0.04, 0.1, 0.05, 0.08;
  constexpr int kRuns = 1000;
  for (bool const round : {false, true}) {
    Symmetry const symmetry = round ? Symmetry{kAxis, {}} : Symmetry{};
    double const expected = round ? 5 : 6;
    EXPECT_NEAR(mean_nees(generator, sigma, deviations(0.01, 0.03), 8, kRuns, symmetry), expected,
                3 * std::sqrt(2 * expected / kRuns) + 0.05);
  }
}

// A prior that is sure which way is up and hardly of the yaw: the update turns the pose by up to
// two and a half radians, and must not turn the certainty with it.
TEST(UpdatedPose, ErrorAndCovarianceAgreeAfterLargeTurns) {
  std::mt19937 generator(9);
  Vector6d sigma;
  sigma << 0.05, 0.03, 0.04, 0.01, 0.1, 0.9;
  // What is not linear in turns of a radian makes it a little more.
  EXPECT_NEAR(mean_nees(generator, sigma, deviations(0.01, 0.1), 3, 2000, {}), 6.0, 0.5);
}

TEST(UpdatedPose, NoNumberOfLooksMakesItSurerThanItsShare) {
  PoseDistribution pose = about(kPose, deviations(0.05, 0.1));
  PoseDistribution detected = about(kPose, deviations(0.01, 0.02));
  detected.covariance(0, 4) = detected.covariance(4, 0) = 1e-4;
  for (double const weight : {1.0, 0.1}) {
    for (int look = 0; look < 2000; ++look) {
      pose = updated_pose(pose, detected, {}, {.weight = weight, .min_covariance_share = 0.05});
    }
    EXPECT_NEAR((20.0 * pose.covariance - detected.covariance).norm(), 0,
                1e-6 * detected.covariance.norm());
  }
  // What moves slowly is followed: each look counts for a twentieth.
  for (int look = 0; look < 100; ++look) {
    detected.mean =
        Se3(detected.mean.rotation(), detected.mean.translation() + Vector3d(1e-3, 0, 0));
    pose = updated_pose(pose, detected, {}, {.min_covariance_share = 0.05});
  }
  EXPECT_LT((pose.mean.translation() - detected.mean.translation()).norm(), 0.025);
}

TEST(UpdatedPose, ForgettingLeavesWhatCannotBeSeen) {
  std::mt19937 generator(12);
  Symmetry const symmetry{kAxis, {}};
  Vector6d sigma;
  sigma << 0.02, 0.05, 0.03, 0.1, 0.2, 0.15;
  PoseDistribution pose = about(boxplus(kPose, drawn(generator, sigma)), sigma);
  double const before = unseen_information(pose, kAxis);
  for (int look = 0; look < 500; ++look) {
    PoseDistribution const found =
        about(boxplus(kPose, drawn(generator, deviations(0.01, 0.03))), deviations(0.01, 0.03));
    pose = updated_pose(pose, found, symmetry, {.min_covariance_share = 0.05});
  }
  EXPECT_NEAR(unseen_information(pose, kAxis), before, 1e-6 * before);
  EXPECT_GT((pose.covariance.topLeftCorner<3, 3>().trace()), 0.9 * 3 * 0.01 * 0.01 / 20);
}

}  // namespace
}  // namespace credo::test
