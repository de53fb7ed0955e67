#include "geometry/bingham/bingham.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "core/se3.hpp"

namespace credo::test {
namespace {

using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

Quaterniond const kFirst = so3_exp({0.4, -1.1, 0.7});
Quaterniond const kSecond = so3_exp({-0.9, 0.2, 1.3});

Bingham const kSkew(left_product(wxyz(kFirst)) * right_product(wxyz(kSecond)), {-30, -12, -2});

double same_rotation(Quaterniond const& a, Quaterniond const& b) {
  return std::abs(a.dot(b));
}

TEST(QuaternionProducts, AreEigens) {
  EXPECT_LT((left_product(wxyz(kFirst)) * wxyz(kSecond) - wxyz(kFirst * kSecond)).norm(), 1e-15);
  EXPECT_LT((right_product(wxyz(kSecond)) * wxyz(kFirst) - wxyz(kFirst * kSecond)).norm(), 1e-15);
  EXPECT_EQ(quaternion_of(wxyz(kFirst)).coeffs(), kFirst.coeffs());
  EXPECT_EQ(wxyz(kFirst)[0], kFirst.w());
}

TEST(Bingham, ComesBackFromItsParameters) {
  Matrix4d const A = kSkew.parameters();
  EXPECT_LT((A - A.transpose()).norm(), 1e-13);
  for (double const shift : {0.0, 1.0, -1000.0}) {
    Bingham const again = Bingham::of_parameters(A + shift * Matrix4d::Identity());
    EXPECT_LT((again.concentrations() - kSkew.concentrations()).norm(), 1e-11);
    EXPECT_LT((again.parameters() - A).norm(), 1e-11);
    EXPECT_NEAR(same_rotation(again.mode(), kSkew.mode()), 1.0, 1e-13);
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(std::abs(again.axes().col(i).dot(kSkew.axes().col(i))), 1.0, 1e-12);
    }
  }
}

TEST(Bingham, TakesTheSymmetricPart) {
  Matrix4d A = kSkew.parameters();
  A(0, 3) += 1.5;
  A(3, 0) -= 1.5;
  EXPECT_LT((Bingham::of_parameters(A).parameters() - kSkew.parameters()).norm(), 1e-12);
}

TEST(Bingham, RatioToModeIsTheQuadraticForm) {
  EXPECT_NEAR(kSkew.log_ratio_to_mode(kSkew.mode()), 0.0, 1e-13);
  EXPECT_NEAR(kSkew.log_ratio_to_mode(quaternion_of(kSkew.axes().col(1))), -12.0, 1e-12);
  Vector4d const q = wxyz(kSecond);
  EXPECT_NEAR(kSkew.log_ratio_to_mode(kSecond), q.dot(kSkew.parameters() * q), 1e-12);
}

TEST(Bingham, IsUniformToBeginWith) {
  Bingham const uniform;
  EXPECT_EQ(uniform.log_ratio_to_mode(kFirst), 0.0);
  EXPECT_EQ(uniform.mode().coeffs(), Quaterniond::Identity().coeffs());
  EXPECT_EQ(Bingham::of_parameters(Matrix4d::Zero()).concentrations(), Vector3d::Zero());
  EXPECT_EQ(Bingham::of_parameters(7.0 * Matrix4d::Identity()).concentrations(), Vector3d::Zero());
}

TEST(Bingham, RefusesWhatIsNone) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  Matrix4d const identity = Matrix4d::Identity();
  EXPECT_THROW(Bingham(1.01 * identity, {-1, -1, -1}), std::logic_error);
  EXPECT_THROW(Bingham(nan * identity, {-1, -1, -1}), std::logic_error);
  for (Vector3d const& z : {Vector3d(-1, -2, 0), Vector3d(-2, -1, 0.1), Vector3d(-1, 0, -1),
                            Vector3d(nan, -1, -1), Vector3d(-1, -1, nan)}) {
    EXPECT_THROW(Bingham(identity, z), std::logic_error);
  }
  Matrix4d A = identity;
  A(1, 2) = nan;
  EXPECT_THROW((void)Bingham::of_parameters(A), std::logic_error);
}

TEST(Product, AddsLogarithms) {
  Bingham const other(right_product(wxyz(kFirst)), {-9, -3, -1});
  Bingham const both = product(kSkew, other);
  auto const apart = [&](Quaterniond const& q) {
    return kSkew.log_ratio_to_mode(q) + other.log_ratio_to_mode(q) - both.log_ratio_to_mode(q);
  };
  EXPECT_NEAR(apart(kFirst), apart(kSecond), 1e-12);
  EXPECT_NEAR(apart(kFirst), apart(both.mode()), 1e-12);
  EXPECT_LT((product(kSkew, {}).parameters() - kSkew.parameters()).norm(), 1e-12);
}

TEST(Rotated, CarriesTheDensityAlong) {
  for (Quaterniond const& q : {kFirst, kSecond, kFirst * kSecond}) {
    double const before = kSkew.log_ratio_to_mode(q);
    EXPECT_NEAR(rotated_left(kSecond, kSkew).log_ratio_to_mode(kSecond * q), before, 1e-12);
    EXPECT_NEAR(rotated_right(kSkew, kSecond).log_ratio_to_mode(q * kSecond), before, 1e-12);
    EXPECT_NEAR(inverse(kSkew).log_ratio_to_mode(q.conjugate()), before, 1e-12);
  }
  EXPECT_THROW((void)rotated_left(Quaterniond(2, 0, 0, 0), kSkew), std::logic_error);
}

}  // namespace
}  // namespace credo::test
