#include "baselines/refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "baselines/model_cloud.hpp"
#include "sim/household.hpp"

namespace credo::test {
namespace {

ModelCloud cloud_of(char const* name) {
  auto const models = household_models();
  return model_cloud(*std::ranges::find(models, name, &ObjectModel::name), 0.006);
}

/// What a camera at the origin sees of the model at a pose, in the camera frame.
NormalCloud::Ptr seen_at(NormalCloud const& model, Eigen::Isometry3f const& pose) {
  NormalCloud::Ptr seen = facing_points(model, pose);
  for (pcl::PointNormal& point : *seen) {
    point.getVector3fMap() = pose * Eigen::Vector3f(point.getVector3fMap());
    point.getNormalVector3fMap() = pose.linear() * Eigen::Vector3f(point.getNormalVector3fMap());
  }
  return seen;
}

Eigen::Isometry3f ahead(float turn_rad) {
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.translation() = Eigen::Vector3f(0.1F, 0.05F, 1.0F);
  pose.linear() =
      Eigen::AngleAxisf(turn_rad, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  return pose;
}

TEST(Refinement, ComesBackFromTwoCentimetresAndTenDegrees) {
  ModelCloud const model = cloud_of("jug");
  Eigen::Isometry3f const truth = ahead(1.0F);
  Eigen::Isometry3f guess = ahead(1.17F);
  guess.translation() += Eigen::Vector3f(0.012F, -0.012F, 0.01F);
  Eigen::Isometry3f const found =
      refined(seen_at(*model.points, truth), searched(model.points), guess, {30, 0.05});
  EXPECT_LT((found.translation() - truth.translation()).norm(), 0.003F);
  EXPECT_LT(Eigen::AngleAxisf(found.linear().transpose() * truth.linear()).angle(), 0.03F);
}

TEST(Refinement, WhatNothingTellsStaysAsItWas) {
  // Of a box only one side is seen: a plane, which tells nothing of shifts along it.
  ModelCloud const model = cloud_of("cereal_box");
  Eigen::Isometry3f const guess = ahead(0.0F);
  auto const side = std::make_shared<NormalCloud>();
  for (pcl::PointNormal const& point : *seen_at(*model.points, guess)) {
    if (std::abs(point.normal_x) > 0.9F && std::abs(point.y - 0.05F) < 0.05F) {
      side->push_back(point);
      side->back().x += 0.004F;
    }
  }
  ASSERT_GT(side->size(), 30U);
  Eigen::Isometry3f const found = refined(side, searched(model.points), guess, {20, 0.02});
  Eigen::Vector3f const moved = found.translation() - guess.translation();
  EXPECT_NEAR(moved.x(), 0.004F, 0.001F);
  EXPECT_LT(moved.tail<2>().norm(), 0.002F);
}

TEST(Refinement, TooFewPointsLeaveTheGuess) {
  ModelCloud const model = cloud_of("jug");
  Eigen::Isometry3f const guess = ahead(0.5F);
  auto const few = first_points(*seen_at(*model.points, ahead(0.4F)), 3);
  EXPECT_TRUE(refined(few, searched(model.points), guess, {}).isApprox(guess));
}

}  // namespace
}  // namespace credo::test
