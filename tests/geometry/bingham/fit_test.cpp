#include "geometry/bingham/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "core/se3.hpp"
#include "geometry/bingham/sampling.hpp"
#include "support/literal_bingham.hpp"

namespace credo::test {
namespace {

using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Matrix4d skew_axes() {
  return left_product(wxyz(so3_exp({0.4, -1.1, 0.7}))) *
         right_product(wxyz(so3_exp({-0.9, 0.2, 1.3})));
}

std::vector<Quaterniond> draws(Bingham const& distribution, int count, std::mt19937_64& random) {
  std::vector<Quaterniond> result;
  for (int i = 0; i < count; ++i) {
    result.push_back(sample(distribution, random));
  }
  return result;
}

TEST(ScatterOf, IsTheSumOverTheSphere) {
  Bingham const distribution(skew_axes(), {-10, -5, -1});
  SphereIntegral const literal = literal_sphere_integral(distribution.parameters());
  EXPECT_LT((scatter_of(distribution) - literal.scatter).norm(), 1e-7);
}

TEST(FitToScatter, FindsTheDistributionOfTheScatter) {
  for (Vector3d const& z :
       {Vector3d(0, 0, 0), Vector3d(-1e-3, -1e-4, 0), Vector3d(-1, -1, -1), Vector3d(-3, -2, -1),
        Vector3d(-10, -5, -1), Vector3d(-20, -20, -20), Vector3d(-100, -100, 0),
        Vector3d(-100, -100, -1), Vector3d(-300, -50, -10), Vector3d(-900, -100, -1),
        Vector3d(-2000, -2000, -5), Vector3d(-9e4, -3, -2), Vector3d(-9e4, -8e4, -7e4)}) {
    Bingham const distribution(skew_axes(), z);
    Bingham const fitted = fit_to_scatter(3.0 * scatter_of(distribution));
    EXPECT_LT((fitted.concentrations() - z).cwiseAbs().maxCoeff(), 1e-6 * (1.0 - z[0]))
        << fitted.concentrations().transpose() << " for " << z.transpose();
    EXPECT_LT((scatter_of(fitted) - scatter_of(distribution)).norm(), 1e-10) << z.transpose();
  }
}

TEST(FitBingham, FindsWhatWasDrawnFrom) {
  Bingham const distribution(skew_axes(), {-300, -50, -10});
  std::mt19937_64 random(1);
  std::vector<Quaterniond> rotations = draws(distribution, 40000, random);
  // A concentration has a relative error of sqrt(2 / n), that of a variance.
  Vector3d const fitted = fit_bingham(rotations).concentrations();
  EXPECT_LT((fitted.array() / distribution.concentrations().array() - 1.0).abs().maxCoeff(), 0.03);
  EXPECT_LT(fit_bingham(rotations).mode().angularDistance(distribution.mode()), 0.01);
  for (std::size_t i = 0; i < rotations.size(); i += 2) {
    rotations[i].coeffs() *= -1.0;
  }
  EXPECT_EQ(fit_bingham(rotations).concentrations(), fitted);
}

TEST(FitBingham, AWeightIsSoManyOfTheSame) {
  std::mt19937_64 random(2);
  std::vector<Quaterniond> const rotations = draws({skew_axes(), {-9, -4, -2}}, 20, random);
  std::vector<double> weights(rotations.size(), 0.5);
  weights[3] = 1.5;
  weights[5] = 0.0;
  std::vector<Quaterniond> repeated;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    repeated.insert(repeated.end(), static_cast<std::size_t>(2.0 * weights[i]), rotations[i]);
  }
  EXPECT_LT(
      (fit_bingham(rotations, weights).parameters() - fit_bingham(repeated).parameters()).norm(),
      1e-8);
}

TEST(FitBingham, OneRotationIsAsSureAsAFitMayBe) {
  Quaterniond const one = so3_exp({0.3, 0.2, -0.6});
  Bingham const point = fit_bingham(std::vector<Quaterniond>{one, one});
  EXPECT_EQ(point.concentrations(), Vector3d::Constant(kLeastFittedConcentration));
  EXPECT_LT(point.mode().angularDistance(one), 1e-7);
}

// Two rotations about one axis leave a circle: two concentrations at the bound, while the third
// still fits.
TEST(FitBingham, AtTheBoundTheOthersStillFit) {
  std::vector<Quaterniond> const both = {so3_exp({0.0, 0.0, 0.8}), so3_exp({0.0, 0.0, -0.8})};
  Bingham const circle = fit_bingham(both);
  EXPECT_EQ(circle.concentrations()[0], kLeastFittedConcentration);
  EXPECT_EQ(circle.concentrations()[1], kLeastFittedConcentration);
  double const moment = std::sin(0.4) * std::sin(0.4);
  Matrix4d const scatter = scatter_of(circle);
  EXPECT_NEAR(scatter(3, 3), moment, 1e-9);
  EXPECT_LT(circle.mode().angularDistance(Quaterniond::Identity()), 1e-7);
}

TEST(FitBingham, NoRotationsAreUniform) {
  EXPECT_EQ(fit_bingham({}).concentrations(), Vector3d::Zero());
  std::vector<Quaterniond> const one = {Quaterniond::Identity()};
  EXPECT_EQ(fit_bingham(one, std::vector<double>{0.0}).concentrations(), Vector3d::Zero());
  EXPECT_LT(fit_to_scatter(Matrix4d::Identity()).concentrations().norm(), 1e-9);
}

TEST(FitBingham, RefusesWhatHasNoFit) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Quaterniond> const one = {Quaterniond::Identity()};
  EXPECT_THROW((void)fit_bingham(one, std::vector<double>{1.0, 1.0}), std::logic_error);
  EXPECT_THROW((void)fit_bingham(one, std::vector<double>{-1.0}), std::logic_error);
  EXPECT_THROW((void)fit_bingham(one, std::vector<double>{nan}), std::logic_error);
  // Also where another makes up for it.
  std::vector<Quaterniond> const two = {Quaterniond::Identity(), so3_exp({0.3, 0.2, -0.6})};
  EXPECT_THROW((void)fit_bingham(two, std::vector<double>{2.0, -1.0}), std::logic_error);
  EXPECT_THROW((void)fit_bingham(std::vector<Quaterniond>{{nan, 0, 0, 0}}), std::logic_error);
  EXPECT_THROW((void)fit_to_scatter(Matrix4d::Zero()), std::logic_error);
  EXPECT_THROW((void)fit_to_scatter(-Matrix4d::Identity()), std::logic_error);
  Matrix4d hole = Matrix4d::Identity();
  hole(0, 2) = nan;
  EXPECT_THROW((void)fit_to_scatter(hole), std::logic_error);
}

TEST(Composition, IsWhatWasWorkedOut) {
  Matrix4d const axes = Bingham{}.axes();
  Bingham const both = composition({axes, {-100, -50, -20}}, {axes, {-200, -80, -10}});
  Matrix4d const scatter = scatter_of(both);
  EXPECT_NEAR(scatter(1, 1), 0.0078196, 5e-8);
  EXPECT_NEAR(scatter(2, 2), 0.0158482, 5e-8);
  EXPECT_NEAR(scatter(3, 3), 0.0753429, 5e-8);
  EXPECT_LT((both.concentrations() - Vector3d(-64.5208, -32.1402, -7.3544)).cwiseAbs().maxCoeff(),
            1e-4);
  EXPECT_NEAR(both.mode().w(), 1.0, 1e-12);
}

TEST(Composition, HasTheScatterOfProductsOfDraws) {
  Bingham const a(skew_axes(), {-40, -15, -3});
  Bingham const b(right_product(wxyz(so3_exp({1.0, 0.5, -0.4}))), {-25, -20, -1});
  std::mt19937_64 random(5);
  constexpr int kDraws = 100000;
  Matrix4d drawn = Matrix4d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    Eigen::Vector4d const q = wxyz(sample(a, random) * sample(b, random));
    drawn += q * q.transpose() / kDraws;
  }
  EXPECT_LT((scatter_of(composition(a, b)) - drawn).cwiseAbs().maxCoeff(), 0.004);
  EXPECT_GT((scatter_of(composition(b, a)) - drawn).cwiseAbs().maxCoeff(), 0.02);
}

TEST(Composition, WithACertainRotationIsARotation) {
  Bingham const a(skew_axes(), {-40, -15, -3});
  Quaterniond const turn = so3_exp({0.3, 0.2, -0.6});
  Bingham const point = rotated_left(turn, {Bingham{}.axes(), Vector3d::Constant(-1e8)});
  EXPECT_LT((composition(point, a).parameters() - rotated_left(turn, a).parameters()).norm(), 1e-3);
  EXPECT_LT((composition(a, point).parameters() - rotated_right(a, turn).parameters()).norm(),
            1e-3);
  EXPECT_LT(composition(a, {}).concentrations().norm(), 1e-9);
}

}  // namespace
}  // namespace credo::test
