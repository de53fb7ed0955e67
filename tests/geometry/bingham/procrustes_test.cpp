#include "geometry/bingham/procrustes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "geometry/bingham/fit.hpp"
#include "geometry/bingham/tangent.hpp"
#include "geometry/random_draws.hpp"

namespace credo::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d normal_vector(std::mt19937_64& random) {
  double const x = draw_normal(random);
  double const y = draw_normal(random);
  return {x, y, draw_normal(random)};
}

Quaterniond const kTurn = Quaterniond(0.9, 0.3, -0.2, 0.1).normalized();
Se3 const kPose(kTurn, {0.4, -0.3, 1.2});
std::vector<Vector3d> const kModel_m = {
    {0.1, 0, 0}, {0, 0.08, 0}, {0, 0, 0.06}, {-0.05, -0.04, 0.02}};

std::vector<PointMatch> exact_points(Se3 const& pose, double sigma_m) {
  std::vector<PointMatch> points;
  for (Vector3d const& p : kModel_m) {
    points.push_back({p, pose * p, sigma_m});
  }
  return points;
}

std::vector<PointMatch> noisy_points(Se3 const& pose, std::mt19937_64& random) {
  std::vector<PointMatch> points = exact_points(pose, 0.005);
  for (PointMatch& point : points) {
    point.observed_m += point.sigma_m * normal_vector(random);
  }
  return points;
}

Vector3d deviations_deg(Vector3d const& z) {
  return (-2.0 * z.cwiseInverse()).cwiseSqrt() * 180.0 / std::numbers::pi;
}

TEST(Align, IsWhatWasWorkedOut) {
  std::vector<PointMatch> const points = exact_points(kPose, 0.005);
  ProcrustesPose const pose = align(points);
  Vector3d const z = pose.rotation.concentrations();
  EXPECT_LT((z - Vector3d(-1613.487, -1168.523, -717.990)).cwiseAbs().maxCoeff(), 6e-4);
  EXPECT_LT((deviations_deg(z) - Vector3d(2.017, 2.370, 3.024)).cwiseAbs().maxCoeff(), 6e-4);
  // Horn's matrix has no trace: its largest eigenvalue is a quarter of what all others lack.
  EXPECT_NEAR(-z.sum() / 4.0, 875.0, 1e-9);
  Se3 const best = best_pose(pose);
  EXPECT_LT(boxminus(best, kPose).norm(), 1e-9);
  EXPECT_NEAR(pose.weight_per_m2, 4.0 / (0.005 * 0.005), 1e-6);
}

/// The log-likelihood of a pose but for its constant, term by term.
double literal_log_likelihood(Se3 const& pose, std::vector<PointMatch> const& points,
                              std::vector<DirectionMatch> const& directions) {
  double sum = 0.0;
  for (PointMatch const& point : points) {
    sum -= 0.5 * (point.observed_m - pose * point.model_m).squaredNorm() /
           (point.sigma_m * point.sigma_m);
  }
  for (DirectionMatch const& direction : directions) {
    sum += direction.kappa * direction.observed.dot(pose.rotation() * direction.model);
  }
  return sum;
}

// Bingham over the rotation times normal over the translation is the likelihood, everywhere.
TEST(Align, IsTheLikelihoodOfEveryPose) {
  std::mt19937_64 random(1);
  std::vector<PointMatch> points = noisy_points(kPose, random);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].sigma_m = 0.05 + 0.03 * static_cast<double>(i);
  }
  std::vector<DirectionMatch> const directions = {
      {Vector3d(1, 2, 2) / 3.0, kTurn * Vector3d(2, 1, 2) / 3.0, 20.0}};
  ProcrustesPose const pose = align(points, directions);
  Bingham const prior =
      bingham_of_world_covariance(so3_exp({0.2, 0.9, 0.1}), Vector3d(0.1, 0.2, 0.3).asDiagonal());
  ProcrustesPose const with_prior = align(points, directions, prior);
  double offset = 0.0;
  double offset_with_prior = 0.0;
  for (int run = 0; run < 100; ++run) {
    Se3 const any(so3_exp(1.5 * normal_vector(random)), 0.3 * normal_vector(random));
    double const of_translation =
        -0.5 * pose.weight_per_m2 *
        (any.translation() - pose.translation_m(any.rotation())).squaredNorm();
    double const literal = literal_log_likelihood(any, points, directions);
    double const difference =
        pose.rotation.log_ratio_to_mode(any.rotation()) + of_translation - literal;
    double const difference_with_prior = with_prior.rotation.log_ratio_to_mode(any.rotation()) +
                                         of_translation -
                                         (literal + prior.log_ratio_to_mode(any.rotation()));
    if (run == 0) {
      offset = difference;
      offset_with_prior = difference_with_prior;
    }
    EXPECT_NEAR(difference, offset, 1e-8);
    EXPECT_NEAR(difference_with_prior, offset_with_prior, 1e-8);
  }
}

TEST(Align, ErrorsOfTheBestPoseAreAsLargeAsTold) {
  std::mt19937_64 random(2);
  constexpr int kTrials = 4000;
  // The axes of the exact one: body axes of each turn.
  Bingham const exact = align(exact_points(kPose, 0.005)).rotation;
  Vector3d squares = Vector3d::Zero();
  double nees = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    ProcrustesPose const pose = align(noisy_points(kPose, random));
    squares += 4.0 *
               (exact.axes().leftCols<3>().transpose() * wxyz(pose.rotation.mode())).cwiseAbs2() /
               kTrials;
    PoseDistribution const told = pose_distribution(pose);
    Vector6d const error = boxminus(kPose, told.mean);
    nees += error.dot(told.covariance.inverse() * error) / kTrials;
  }
  Vector3d const deviation_deg = squares.cwiseSqrt() * 180.0 / std::numbers::pi;
  // One deviation of these means is 1.1 %.
  Vector3d const expected(2.025, 2.366, 3.040);
  EXPECT_LT((deviation_deg.array() / expected.array() - 1.0).abs().maxCoeff(), 0.035)
      << deviation_deg.transpose();
  EXPECT_NEAR(nees, 6.0, 3.0 * std::sqrt(12.0 / kTrials) + 0.05);
}

TEST(Align, ANormalAloneLeavesTheTurnAboutIt) {
  std::vector<PointMatch> const point = {{{0.1, 0.2, 0.3}, {1, 2, 3}, 0.01}};
  Vector3d const of_model = Vector3d(1, 2, 2) / 3.0;
  std::vector<DirectionMatch> const normal = {{of_model, kTurn * of_model, kNormalKappa}};
  Bingham const rotation = align(point, normal).rotation;
  EXPECT_LT((rotation.concentrations() - Vector3d(-100, -100, 0)).norm(), 1e-12);
  EXPECT_LT((rotation.mode() * of_model - kTurn * of_model).norm(), 1e-12);
  EXPECT_NEAR(rotation.log_ratio_to_mode(kTurn * so3_exp(2.0 * of_model)), 0.0, 1e-12);
}

TEST(Align, OnePointLeavesTheRotationAndTwoTheTurnAboutTheirLine) {
  std::vector<PointMatch> points = exact_points(kPose, 0.005);
  points.resize(1);
  ProcrustesPose const one = align(points);
  EXPECT_EQ(one.rotation.concentrations(), Vector3d::Zero());
  Quaterniond const any = so3_exp({2.0, 0.3, -0.4});
  EXPECT_LT((Se3(any, one.translation_m(any)) * kModel_m[0] - kPose * kModel_m[0]).norm(), 1e-12);

  points = exact_points(kPose, 0.005);
  points.resize(2);
  Bingham const two = align(points).rotation;
  // The moment is half the squared distance over the variance.
  double const expected = -(0.1 * 0.1 + 0.08 * 0.08) / (0.005 * 0.005);
  EXPECT_LT((two.concentrations() - Vector3d(expected, expected, 0)).norm(), 1e-9);
}

TEST(Align, MovesWithTheScene) {
  std::mt19937_64 random(3);
  std::vector<PointMatch> points = noisy_points(kPose, random);
  PoseDistribution const before = pose_distribution(align(points));
  Se3 const motion(so3_exp({1.0, 0.4, -2.0}), {5, 6, -7});
  for (PointMatch& point : points) {
    point.observed_m = motion * point.observed_m;
  }
  PoseDistribution const after = pose_distribution(align(points));
  PoseDistribution const expected = transformed(motion, before);
  EXPECT_LT(boxminus(after.mean, expected.mean).norm(), 1e-9);
  EXPECT_LT((after.covariance - expected.covariance).norm(), 1e-9);
}

TEST(Align, RefusesWhatIsNoMatch) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)align({}), std::logic_error);
  std::vector<PointMatch> points = exact_points(kPose, 0.005);
  points[1].sigma_m = 0.0;
  EXPECT_THROW((void)align(points), std::logic_error);
  points[1].sigma_m = nan;
  EXPECT_THROW((void)align(points), std::logic_error);
  points = exact_points(kPose, 0.005);
  points[2].observed_m.y() = nan;
  EXPECT_THROW((void)align(points), std::logic_error);
  points = exact_points(kPose, std::numeric_limits<double>::infinity());
  EXPECT_THROW((void)align(points), std::logic_error);
  points = exact_points(kPose, 0.005);
  std::vector<DirectionMatch> const hole = {{Vector3d::UnitX(), Vector3d(nan, 0, 0), 1.0}};
  EXPECT_THROW((void)align(points, hole), std::logic_error);
}

TEST(PoseDistributionOf, IsThatOfDraws) {
  // Small errors, so that the first order is all; far from the model's origin, so that turns and
  // shifts go together.
  std::vector<PointMatch> points = exact_points(kPose, 0.001);
  for (PointMatch& point : points) {
    point.model_m += Vector3d(0.3, -0.1, 0.2);
  }
  ProcrustesPose const pose = align(points);
  PoseDistribution const told = pose_distribution(pose);
  std::mt19937_64 random(4);
  constexpr int kDraws = 40000;
  Matrix6d drawn = Matrix6d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    Vector6d const error = boxminus(sample_pose(pose, random), told.mean);
    drawn += error * error.transpose() / kDraws;
  }
  // In units in which the covariance told is 1.
  Eigen::LLT<Matrix6d> const root(told.covariance);
  Matrix6d const half = root.matrixL().solve(drawn);
  Matrix6d const relative = root.matrixL().solve(half.transpose());
  EXPECT_LT((relative - Matrix6d::Identity()).cwiseAbs().maxCoeff(), 0.03) << relative;
  EXPECT_EQ(told.covariance, told.covariance.transpose());
}

TEST(SamplePose, TranslationFollowsTheRotation) {
  ProcrustesPose const pose = align(exact_points(kPose, 0.005));
  std::mt19937_64 random(5);
  constexpr int kDraws = 20000;
  Matrix3d drawn = Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    Se3 const any = sample_pose(pose, random);
    Vector3d const error = any.translation() - pose.translation_m(any.rotation());
    drawn += error * error.transpose() / kDraws;
  }
  EXPECT_LT((drawn * pose.weight_per_m2 - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.04);
}

}  // namespace
}  // namespace credo::test
