// Frames, whose curvature directions have no sign, and what is known beforehand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "geometry/bingham/procrustes.hpp"
#include "geometry/bingham/tangent.hpp"
#include "geometry/random_draws.hpp"

namespace credo::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond const kTurn = so3_exp({0.6, -0.4, 1.1});
Se3 const kPose(kTurn, {0.4, -0.3, 1.2});
Vector3d const kNormal = Vector3d(1, 2, 2) / 3.0;
Vector3d const kCurvature = Vector3d(2, 1, -2) / 3.0;

/// `sign`: in which direction the curvature happens to be observed.
FrameMatch frame(Vector3d const& normal, Vector3d const& curvature, double sign,
                 double curvature_kappa = 20.0) {
  return {{normal, kTurn * normal, 50.0}, {curvature, sign * (kTurn * curvature), curvature_kappa}};
}

PointMatch exact_point(Vector3d const& model_m) {
  return {model_m, kPose * model_m, 0.01};
}

TEST(CurvatureKappa, IsTheAuthors) {
  EXPECT_EQ(curvature_kappa(1.0), 0.0);
  EXPECT_EQ(curvature_kappa(3.0), 10.0);
  EXPECT_EQ(curvature_kappa(11.0), 50.0);
  EXPECT_EQ(curvature_kappa(INFINITY), 50.0);
}

// Of one correspondence: concentrations are twice the kappas, and both signs come.
TEST(AlignFrames, OneIsEitherOfTwo) {
  std::vector<FrameMatch> const frames = {frame(kNormal, kCurvature, 1.0)};
  std::mt19937_64 random(1);
  int as_told = 0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    // The mean of one point is that point but for rounding, which must not decide.
    std::vector<PointMatch> const points = {
        {{draw_normal(random), draw_normal(random), 0.1}, {0.3, draw_normal(random), 1.7}, 0.003}};
    Bingham const rotation = align({points, {}, frames}, random).rotation;
    EXPECT_LT((rotation.concentrations() - Vector3d(-140, -100, -40)).norm(), 1e-10);
    EXPECT_LT((rotation.mode() * kNormal - kTurn * kNormal).norm(), 1e-10);
    double const along = (rotation.mode() * kCurvature).dot(kTurn * kCurvature);
    EXPECT_NEAR(std::abs(along), 1.0, 1e-10);
    as_told += along > 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(as_told, kRuns / 2, 4.0 * std::sqrt(kRuns) / 2.0);
}

TEST(AlignFrames, SeveralFollowThePoints) {
  std::vector<PointMatch> const points = {exact_point({0.1, 0.0, 0.05}),
                                          exact_point({0.0, 0.07, 0.0}),
                                          exact_point({-0.04, 0.0, 0.02})};
  Vector3d const other = kNormal.cross(kCurvature);
  std::mt19937_64 random(2);
  std::mt19937_64 const before = random;
  for (double const first : {1.0, -1.0}) {
    for (double const second : {1.0, -1.0}) {
      std::vector<FrameMatch> const frames = {frame(kNormal, kCurvature, first),
                                              frame(kCurvature, other, second),
                                              frame(other, kNormal, -first)};
      ProcrustesPose const pose = align({points, {}, frames}, random);
      EXPECT_LT(boxminus(best_pose(pose), kPose).norm(), 1e-9);
      // As if the signs had been known.
      std::vector<DirectionMatch> known;
      for (FrameMatch const& match : frames) {
        known.push_back(match.normal);
        known.push_back(match.curvature);
        known.back().observed = kTurn * match.curvature.model;
      }
      EXPECT_LT((align(points, known).rotation.parameters() - pose.rotation.parameters()).norm(),
                1e-9);
    }
  }
  EXPECT_EQ(random, before) << "nothing was to be drawn";
}

// Each candidate is judged by how much the points like the rotation it stands for: that of the
// observed frame, put upright where the curvature is off the right angle.
TEST(AlignFrames, TheSignIsThatOfTheRotationLikedBetter) {
  std::mt19937_64 random(3);
  int flipped = 0;
  for (int run = 0; run < 300; ++run) {
    std::vector<PointMatch> points;
    for (int i = 0; i < 3; ++i) {
      Vector3d const model_m(draw_normal(random), draw_normal(random), draw_normal(random));
      points.push_back(
          {model_m, {draw_normal(random), draw_normal(random), draw_normal(random)}, 0.5});
    }
    Quaterniond const any =
        so3_exp({draw_normal(random), draw_normal(random), draw_normal(random)});
    Vector3d const leaning = any * (kCurvature + 0.8 * kNormal).normalized();
    std::vector<FrameMatch> const frames = {
        {{kNormal, any * kNormal, 5.0}, {kCurvature, leaning, 3.0}}};
    Bingham const by_points = align(points).rotation;
    Quaterniond const other = any * so3_exp(std::numbers::pi * kNormal);
    bool const as_told = by_points.log_ratio_to_mode(any) > by_points.log_ratio_to_mode(other);
    flipped += as_told ? 0 : 1;
    std::vector<DirectionMatch> const directions = {
        frames[0].normal, {kCurvature, (as_told ? 1.0 : -1.0) * leaning, 3.0}};
    EXPECT_LT((align(points, directions).rotation.parameters() -
               align({points, {}, frames}, random).rotation.parameters())
                  .norm(),
              1e-9);
  }
  EXPECT_GT(flipped, 100);
  EXPECT_LT(flipped, 200);
}

// Two points in the line of their own normals tell no sign, but the second frame follows the first.
TEST(AlignFrames, FollowEachOther) {
  std::vector<PointMatch> const points = {exact_point(Vector3d::Zero()),
                                          exact_point(0.1 * kNormal)};
  std::mt19937_64 random(4);
  int as_told = 0;
  for (int run = 0; run < 100; ++run) {
    std::vector<FrameMatch> const frames = {frame(kNormal, kCurvature, 1.0),
                                            frame(kNormal, kCurvature, -1.0)};
    Bingham const rotation = align({points, {}, frames}, random).rotation;
    EXPECT_NEAR(rotation.concentrations()[2], -2.0 * 40.0, 1e-9) << "both must agree";
    as_told += (rotation.mode() * kCurvature).dot(kTurn * kCurvature) > 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(as_told, 50, 20);
}

TEST(AlignFrames, APriorTellsTheSign) {
  std::vector<PointMatch> const points = {exact_point({0.1, 0.0, 0.05})};
  std::vector<FrameMatch> const frames = {frame(kNormal, kCurvature, -1.0)};
  std::mt19937_64 random(5);
  Bingham const prior =
      bingham_of_world_covariance(so3_exp({0.2, 0.1, -0.1}) * kTurn, Matrix3d::Identity());
  for (int run = 0; run < 20; ++run) {
    Bingham const rotation = align({points, {}, frames}, random, prior).rotation;
    EXPECT_LT(rotation.mode().angularDistance(kTurn), 0.05);
  }
}

TEST(AlignFrames, ADirectionTellsTheSign) {
  std::vector<PointMatch> const points = {exact_point({0.1, 0.0, 0.05})};
  std::vector<FrameMatch> const frames = {frame(kNormal, kCurvature, -1.0)};
  std::vector<DirectionMatch> const directions = {
      {Vector3d::UnitX(), kTurn * Vector3d::UnitX(), 5.0}};
  std::mt19937_64 random(6);
  for (int run = 0; run < 20; ++run) {
    Bingham const rotation = align({points, directions, frames}, random).rotation;
    EXPECT_LT(rotation.mode().angularDistance(kTurn), 1e-7);
  }
}

std::vector<PointMatch> off_centre_points() {
  std::vector<PointMatch> points;
  for (Vector3d const& model_m :
       {Vector3d(0.4, 0, 0.1), Vector3d(0.3, 0.1, 0), Vector3d(0.35, -0.08, 0.05)}) {
    points.push_back(exact_point(model_m));
  }
  return points;
}

/// Weighted first and second moments of errors about a pose.
struct Moments {
  double weight = 0.0;
  Vector6d first = Vector6d::Zero();
  Matrix6d second = Matrix6d::Zero();

  void add(Vector6d const& error, double by) {
    weight += by;
    first += by * error;
    second += by * error * error.transpose();
  }
  [[nodiscard]] Vector6d mean() const { return first / weight; }
  [[nodiscard]] Matrix6d covariance() const {
    return second / weight - mean() * mean().transpose();
  }
};

double log_normal_density(Vector3d const& error, Matrix3d const& covariance) {
  return -0.5 * error.dot(covariance.inverse() * error) - 0.5 * std::log(covariance.determinant()) -
         1.5 * std::log(2.0 * std::numbers::pi);
}

// The twin draws without the prior and weighs by its density at the translation drawn.
TEST(SamplePoseWithPrior, IsTheWeighedDrawWithoutIt) {
  ProcrustesPose const pose = align(off_centre_points());
  Matrix3d const turn = so3_exp({0.3, 0.9, -0.2}).toRotationMatrix();
  TranslationPrior const prior{kPose.translation() + Vector3d(0.02, -0.03, 0.02),
                               turn * Vector3d(2e-4, 8e-4, 4e-4).asDiagonal() * turn.transpose()};
  std::mt19937_64 random(7);
  Moments with;
  Moments twin;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    WeightedPose const drawn = sample_pose(pose, prior, random);
    with.add(boxminus(drawn.pose, kPose), std::exp(drawn.log_weight));
    Se3 const plain = sample_pose(pose, random);
    twin.add(boxminus(plain, kPose),
             std::exp(log_normal_density(plain.translation() - prior.mean_m, prior.covariance_m2)));
  }
  // The mean weight is the evidence.
  EXPECT_NEAR(with.weight / twin.weight, 1.0, 0.02);
  Vector6d const deviation = twin.covariance().diagonal().cwiseSqrt();
  EXPECT_LT(((with.mean() - twin.mean()).array() / deviation.array()).abs().maxCoeff(), 0.03);
  Matrix6d const scale = deviation * deviation.transpose();
  EXPECT_LT(((with.covariance() - twin.covariance()).array() / scale.array()).abs().maxCoeff(),
            0.04);
  // The prior matters.
  EXPECT_GT(((twin.mean()).array() / deviation.array()).abs().maxCoeff(), 0.5);
}

// Given the rotation, the translation's information is the sum of both.
TEST(SamplePoseWithPrior, TranslationsAddInformation) {
  ProcrustesPose const pose = align(off_centre_points());
  Matrix3d const turn = so3_exp({0.3, 0.9, -0.2}).toRotationMatrix();
  TranslationPrior const prior{kPose.translation(),
                               turn * Vector3d(2e-6, 5e-4, 2e-5).asDiagonal() * turn.transpose()};
  Matrix3d const identity = Matrix3d::Identity();
  Matrix3d const of_prior = prior.covariance_m2.inverse();
  Matrix3d const covariance = (of_prior + pose.weight_per_m2 * identity).inverse();
  std::mt19937_64 random(9);
  constexpr int kDraws = 20000;
  Matrix3d drawn = Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    Se3 const any = sample_pose(pose, prior, random).pose;
    Vector3d const mean = covariance * (of_prior * prior.mean_m +
                                        pose.weight_per_m2 * pose.translation_m(any.rotation()));
    Vector3d const error = any.translation() - mean;
    drawn += error * error.transpose() / kDraws;
  }
  Matrix3d const relative = covariance.inverse() * drawn;
  EXPECT_LT((relative - identity).cwiseAbs().maxCoeff(), 0.3) << relative;
  EXPECT_NEAR(relative.trace(), 3.0, 0.06);
}

TEST(SamplePoseWithPrior, RefusesWhatIsNoCovariance) {
  ProcrustesPose const pose = align(off_centre_points());
  std::mt19937_64 random(8);
  TranslationPrior prior;
  prior.covariance_m2(1, 1) = -1.0;
  EXPECT_THROW((void)sample_pose(pose, prior, random), std::logic_error);
  prior.covariance_m2 = Matrix3d::Constant(NAN);
  EXPECT_THROW((void)sample_pose(pose, prior, random), std::logic_error);
}

}  // namespace
}  // namespace credo::test
