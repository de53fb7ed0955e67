#include "core/se3.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace credo {
namespace {

class Se3Properties : public testing::Test {
protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Eigen::Vector3d vector(double scale) {
    return {uniform(-scale, scale), uniform(-scale, scale), uniform(-scale, scale)};
  }
  Se3 pose() { return {so3_exp(vector(1.8)), vector(5.0)}; }

  static constexpr int kRounds = 300;

private:
  std::mt19937 random_{7};
};

TEST_F(Se3Properties, InverseUndoesAndCompositionIsAssociative) {
  for (int i = 0; i < kRounds; ++i) {
    Se3 const a = pose();
    Se3 const b = pose();
    Se3 const c = pose();
    Eigen::Vector3d const p = vector(3.0);
    EXPECT_LT(((a.inverse() * a).matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
    EXPECT_TRUE(((a * b) * c).matrix().isApprox((a * (b * c)).matrix(), 1e-12));
    EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-12);
    EXPECT_LT((a * p - (a.matrix() * p.homogeneous()).head<3>()).norm(), 1e-12);
  }
}

TEST_F(Se3Properties, LogUndoesExpBelowHalfATurn) {
  for (int i = 0; i < kRounds; ++i) {
    Eigen::Vector3d const phi = vector(1.8);
    EXPECT_LT((so3_log(so3_exp(phi)) - phi).norm(), 1e-12);
  }
  for (double const angle : {0.0, 1e-12, 1e-8, 1e-5, 1e-4, 3.14}) {
    Eigen::Vector3d const phi = angle * Eigen::Vector3d(1, -2, 2).normalized();
    EXPECT_LT((so3_log(so3_exp(phi)) - phi).norm(), 1e-13) << angle;
  }
}

TEST_F(Se3Properties, JacobiansAreThoseOfExp) {
  constexpr double kStep = 1e-6;
  for (double const scale : {1.8, 0.1, 1e-2, 1e-3, 1e-5, 0.0}) {
    for (int i = 0; i < 50; ++i) {
      Eigen::Vector3d const phi = vector(scale);
      Eigen::Matrix3d numeric;
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::Vector3d const step = kStep * Eigen::Vector3d::Unit(axis);
        numeric.col(axis) = so3_log(so3_exp(phi - step).conjugate() * so3_exp(phi + step));
      }
      Eigen::Matrix3d const exact = so3_right_jacobian(phi);
      EXPECT_LT((numeric / (2 * kStep) - exact).norm(), 1e-8);
      EXPECT_LT((so3_right_jacobian_inverse(phi) * exact - Eigen::Matrix3d::Identity()).norm(),
                1e-9);
    }
  }
}

TEST_F(Se3Properties, LogTakesTheShorterWayRound) {
  Eigen::Vector3d const phi(0, 0, 1.5 * std::numbers::pi);
  EXPECT_NEAR(so3_log(so3_exp(phi)).z(), -0.5 * std::numbers::pi, 1e-12);
}

TEST_F(Se3Properties, BoxplusUndoesBoxminus) {
  for (int i = 0; i < kRounds; ++i) {
    Se3 const a = pose();
    Se3 const b = pose();
    EXPECT_TRUE(boxplus(a, boxminus(b, a)).matrix().isApprox(b.matrix(), 1e-10));
    EXPECT_LT(boxminus(a, a).norm(), 1e-12);
  }
}

TEST_F(Se3Properties, ErrorsTurnWithTheFrameTheyAreToldIn) {
  // Moving a pose by an error and then telling it in another frame is the same as telling it there
  // and moving it by the turned error: what transformed() claims of covariances.
  for (int i = 0; i < kRounds; ++i) {
    Se3 const T_a_b = pose();
    Se3 const mean_b = pose();
    Vector6d error_b;
    error_b << vector(0.1), vector(0.1);
    PoseDistribution const told{mean_b, error_b * error_b.transpose()};
    PoseDistribution const moved = transformed(T_a_b, told);
    Vector6d const error_a = boxminus(T_a_b * boxplus(mean_b, error_b), T_a_b * mean_b);
    EXPECT_TRUE(moved.mean.matrix().isApprox((T_a_b * mean_b).matrix(), 1e-12));
    EXPECT_LT((moved.covariance - error_a * error_a.transpose()).norm(), 1e-12);
  }
}

TEST(Se3, FromMatrixTakesRoundingAndRefusesTheRest) {
  Eigen::Matrix4d matrix = Se3(so3_exp({0.1, 0.2, 0.3}), {1, 2, 3}).matrix();
  matrix(0, 0) += 1e-5;
  EXPECT_NEAR(Se3::from_matrix(matrix).rotation().norm(), 1.0, 1e-15);
  auto const refuse = [](Eigen::Matrix4d const& m) {
    EXPECT_THROW(Se3::from_matrix(m), std::invalid_argument);
  };
  refuse(2.0 * matrix);
  Eigen::Matrix4d mirror = Eigen::Matrix4d::Identity();
  mirror(0, 0) = -1;
  refuse(mirror);
  matrix(1, 1) = std::nan("");
  refuse(matrix);
}

TEST(Se3, AZeroQuaternionIsABrokenContract) {
  EXPECT_THROW(Se3(Eigen::Quaterniond(0, 0, 0, 0), {0, 0, 0}), std::logic_error);
}

}  // namespace
}  // namespace credo
