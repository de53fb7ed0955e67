#include "geometry/bingham/tangent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "core/se3.hpp"
#include "geometry/bingham/sampling.hpp"

namespace credo::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond const kMode = so3_exp({0.4, -1.1, 0.7});

/// Symmetric, its axes no coordinate axes.
Matrix3d skew_covariance(Vector3d const& sigma_rad) {
  Matrix3d const R = so3_exp({-0.5, 0.8, 0.3}).toRotationMatrix();
  return R * sigma_rad.cwiseAbs2().asDiagonal() * R.transpose();
}

TEST(TangentCovariance, IsThatOfDraws) {
  Bingham const distribution =
      bingham_of_body_covariance(kMode, skew_covariance({0.03, 0.08, 0.15}));
  std::mt19937_64 random(1);
  constexpr int kDraws = 50000;
  Matrix3d body = Matrix3d::Zero();
  Matrix3d world = Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    Quaterniond const q = sample(distribution, random);
    Vector3d const of_body = so3_log(kMode.conjugate() * q);
    Vector3d const of_world = so3_log(q * kMode.conjugate());
    body += of_body * of_body.transpose() / kDraws;
    world += of_world * of_world.transpose() / kDraws;
  }
  double const tolerance = 0.03 * body.norm();
  EXPECT_LT((tangent_covariance_body_rad2(distribution) - body).norm(), tolerance);
  EXPECT_LT((tangent_covariance_world_rad2(distribution) - world).norm(), tolerance);
  EXPECT_GT((body - world).norm(), 10 * tolerance) << "they must be told apart";
}

TEST(TangentCovariance, ComesBack) {
  Matrix3d const covariance = skew_covariance({0.002, 0.005, 0.01});
  Bingham const body = bingham_of_body_covariance(kMode, covariance);
  Bingham const world = bingham_of_world_covariance(kMode, covariance);
  double const tolerance = 1e-4 * covariance.norm();
  EXPECT_LT((tangent_covariance_body_rad2(body) - covariance).norm(), tolerance);
  EXPECT_LT((tangent_covariance_world_rad2(world) - covariance).norm(), tolerance);
  EXPECT_NEAR(std::abs(body.mode().dot(kMode)), 1.0, 1e-14);
  EXPECT_NEAR(std::abs(world.mode().dot(kMode)), 1.0, 1e-14);
  EXPECT_NEAR(body.concentrations()[2], -2.0 / (0.01 * 0.01), 1e-6);
}

// Around the mode the densities are the same, so that products add information.
TEST(TangentCovariance, ProductsAddInformation) {
  Matrix3d const first = skew_covariance({0.03, 0.08, 0.15});
  Matrix3d const second = skew_covariance({0.2, 0.05, 0.1});
  Bingham const both = product(bingham_of_world_covariance(kMode, first),
                               bingham_of_world_covariance(kMode, second));
  Matrix3d const sum = first.inverse() + second.inverse();
  Bingham const expected = bingham_of_world_covariance(kMode, sum.inverse());
  EXPECT_LT((both.parameters() - expected.parameters()).norm(),
            1e-9 * expected.parameters().norm());
}

TEST(TangentCovariance, IsValidForSmallDeviationsOnly) {
  auto const spread = [](double sigma_rad) {
    return bingham_of_body_covariance(kMode, skew_covariance({0.01, 0.01, sigma_rad}));
  };
  EXPECT_TRUE(is_tangent_covariance_valid(spread(0.36)));
  EXPECT_FALSE(is_tangent_covariance_valid(spread(0.44)));
  EXPECT_FALSE(is_tangent_covariance_valid({}));
  EXPECT_NEAR(tangent_covariance_body_rad2({}).trace(), 3.0, 1e-12);
}

// At the limit of what is called valid the covariance is within 5 % of that of draws.
TEST(TangentCovariance, HoldsUpToItsLimit) {
  Bingham const wide = bingham_of_body_covariance(kMode, skew_covariance({0.35, 0.35, 0.35}));
  ASSERT_TRUE(is_tangent_covariance_valid(wide));
  std::mt19937_64 random(2);
  constexpr int kDraws = 50000;
  double trace = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    trace += so3_log(kMode.conjugate() * sample(wide, random)).squaredNorm() / kDraws;
  }
  EXPECT_NEAR(tangent_covariance_body_rad2(wide).trace() / trace, 1.0, 0.06);
}

TEST(TangentCovariance, NothingIsSurerThanItsBound) {
  Bingham const point = bingham_of_body_covariance(kMode, Matrix3d::Zero());
  EXPECT_LT((point.concentrations() - Vector3d::Constant(-1e9)).norm(), 1.0);
}

TEST(TangentCovariance, RefusesWhatIsNone) {
  Matrix3d covariance = Matrix3d::Identity();
  covariance(2, 2) = -0.1;
  EXPECT_THROW((void)bingham_of_body_covariance(kMode, covariance), std::logic_error);
  covariance(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)bingham_of_body_covariance(kMode, covariance), std::logic_error);
  covariance(2, 2) = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)bingham_of_world_covariance(kMode, covariance), std::logic_error);
}

}  // namespace
}  // namespace credo::test
