#include "eval/camera_scorer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace credo {
namespace {

Se3 on_a_circle(double turn_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ())),
          Eigen::Vector3d(std::cos(turn_rad), std::sin(turn_rad), 1.5)};
}

TEST(CameraScorer, WithoutAFrameSaysNothing) {
  EXPECT_FALSE(CameraScorer{}.scores());
}

TEST(CameraScorer, OneFrameIsItsError) {
  CameraScorer scorer;
  Vector6d error;
  error << 0.03, 0.0, 0.04, 0.0, 0.0, std::numbers::pi / 180.0;
  scorer.add(boxplus(on_a_circle(1), error), on_a_circle(1));
  EXPECT_NEAR(scorer.scores()->translation_m, 0.05, 1e-12);
  EXPECT_NEAR(scorer.scores()->rotation_deg, 1.0, 1e-9);
  EXPECT_NEAR(scorer.scores()->ate_m, 0.0, 1e-12);
}

// A way that is the true one as a whole, elsewhere, has no error of its own.
TEST(CameraScorer, TheWholeWayMovedIsNoErrorOfTheWay) {
  Vector6d error;
  error << 0.1, -0.2, 0.05, 0.01, 0.02, 0.3;
  Se3 const moved = boxplus(Se3{}, error);
  CameraScorer scorer;
  for (int k = 0; k < 50; ++k) {
    scorer.add(moved * on_a_circle(0.1 * k), on_a_circle(0.1 * k));
  }
  EXPECT_GT(scorer.scores()->translation_m, 0.1);
  EXPECT_GT(scorer.scores()->rotation_deg, 10.0);
  EXPECT_NEAR(scorer.scores()->ate_m, 0.0, 1e-9);
}

TEST(CameraScorer, WhatIsTooHighEverySecondTimeIsLeft) {
  CameraScorer scorer;
  for (int k = 0; k < 400; ++k) {
    Vector6d error = Vector6d::Zero();
    error[2] = k % 2 == 0 ? 0.02 : -0.02;
    scorer.add(boxplus(on_a_circle(0.1 * k), error), on_a_circle(0.1 * k));
  }
  EXPECT_NEAR(scorer.scores()->translation_m, 0.02, 1e-12);
  EXPECT_NEAR(scorer.scores()->ate_m, 0.02, 1e-4);
}

}  // namespace
}  // namespace credo
