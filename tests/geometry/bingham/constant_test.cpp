#include "geometry/bingham/constant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/se3.hpp"
#include "support/literal_bingham.hpp"

namespace credo::test {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using std::numbers::pi;

double F(Vector3d const& z) {
  return std::exp(bingham_constant(z).log_F);
}

/// Axes that are no coordinate axes.
Matrix4d skew_axes() {
  return left_product(wxyz(so3_exp({0.4, -1.1, 0.7}))) *
         right_product(wxyz(so3_exp({-0.9, 0.2, 1.3})));
}

struct Oracle {
  Vector3d z;
  double F;
  Vector3d gradient;
  double entropy;
};

/// Worked out to 30 digits.
std::vector<Oracle> oracles() {
  return {
      {{0, 0, 0}, 1.0, Vector3d::Constant(0.25), 2.982606952},
      {{-1, -1, -1}, 0.48861446726428, Vector3d::Constant(0.226622887324), 2.946294103},
      {{-3, -2, -1},
       0.27362483794291,
       {0.148203848603, 0.194147415054, 0.267401322328},
       2.786917335},
      {{-10, -5, -1},
       0.096681593329491,
       {0.0519021775416, 0.105541785818, 0.331603110869},
       2.024608525},
      {{-20, -20, -20}, 0.0065706557789731, Vector3d::Constant(0.0257468826462), -0.4977217263},
      {{-100, -100, 0}, 0.01, {0.005, 0.005, 0.495}, -0.6225632337},
      {{-100, -100, -1},
       0.0064749508542907,
       {0.00501912517779, 0.00501912517779, 0.376072053283},
       -0.6773102204},
      {{-100, -100, -100}, 0.00056850275455879, Vector3d::Constant(0.00502578369885), -2.982162338},
      {{-300, -50, -10},
       0.0015081566320672,
       {0.00166968411425, 0.0101117965087, 0.0533658844482},
       -1.974106291},
      {{-900, -100, -1},
       0.0021546644813395,
       {0.000555789922139, 0.00501909942377, 0.377265964535},
       -1.778126472},
      {{-900, -900, -900}, 2.0913360156226e-5, Vector3d::Constant(0.000555865231225), -6.291679285},
      {{-2000, -2000, -5},
       0.00013506291907431,
       {0.000250073545285, 0.000250073545285, 0.117510866794},
       -4.339314354},
  };
}

TEST(BinghamConstant, IsWhatWasWorkedOutTo30Digits) {
  for (Oracle const& oracle : oracles()) {
    BinghamConstant const constant = bingham_constant(oracle.z);
    EXPECT_NEAR(std::exp(constant.log_F) / oracle.F, 1.0, 2e-10) << oracle.z.transpose();
    // As many digits as the table has, and what 32 nodes leave at its last rows.
    EXPECT_LT(
        ((constant.gradient - oracle.gradient).array() / oracle.gradient.array()).abs().maxCoeff(),
        2e-9)
        << oracle.z.transpose();
    EXPECT_NEAR(entropy(Bingham(skew_axes(), oracle.z)), oracle.entropy, 1e-9)
        << oracle.z.transpose();
  }
}

// The same integral from 1024 nodes and another library's Bessel functions.
TEST(BinghamConstant, HoldsAtExtremes) {
  EXPECT_NEAR(F({-1e5, -10, -1}) / 0.0006579111427489686, 1.0, 1e-9);
  EXPECT_NEAR(F({-1e5, -1e5, -1}) / 6.450377135380963e-06, 1.0, 1e-8);
  EXPECT_NEAR(F({-1e5, -1e5, -1e5}) / 1.7841374973345423e-08, 1.0, 1e-8);
  EXPECT_NEAR(F({-1e5, 0, 0}) / 0.0035682393116515092, 1.0, 1e-9);
  EXPECT_NEAR(F({-1e9, -1e9, -1e9}) / 1.784124117490864e-14, 1.0, 1e-4);
  EXPECT_NEAR(F({-1e9, -1e5, -1}) / 6.45036492113701e-08, 1.0, 1e-4);
}

TEST(BinghamConstant, MeetsItsClosedForms) {
  for (double const z : {-1e-12, -1e-3, -0.7, -5.0, -40.0, -300.0}) {
    EXPECT_NEAR(F({z, 0, 0}) / literal_1F1(0.5, 2.0, z), 1.0, 1e-10) << z;
    EXPECT_NEAR(F({z, z, z}) / literal_1F1(1.5, 2.0, z), 1.0, 1e-10) << z;
    EXPECT_NEAR(F({z, z, 0}) / (std::expm1(z) / z), 1.0, 1e-10) << z;
  }
  Vector3d const large(-3e4, -2e4, -1e4);
  EXPECT_NEAR(F(large) * std::sqrt(pi * -large.prod()), 1.0, 1e-4);
}

TEST(BinghamConstant, IsTheSumOverTheSphere) {
  for (Vector3d const& z : {Vector3d(0, 0, 0), Vector3d(-3, -2, -1), Vector3d(-10, -5, -1),
                            Vector3d(-20, -20, -20), Vector3d(-30, -8, 0)}) {
    Bingham const distribution(skew_axes(), z);
    SphereIntegral const literal = literal_sphere_integral(distribution.parameters());
    BinghamConstant const constant = bingham_constant(z);
    EXPECT_NEAR(std::exp(constant.log_F) / literal.F, 1.0, 1e-7) << z.transpose();
    Matrix4d const along = distribution.axes().transpose() * literal.scatter * distribution.axes();
    EXPECT_LT((along.diagonal().head<3>() - constant.gradient).norm(), 1e-7) << z.transpose();
  }
}

TEST(BinghamConstant, IsNearTheSaddlepoint) {
  for (Oracle const& oracle : oracles()) {
    double const C = 2.0 * pi * pi * F(oracle.z);
    Saddlepoint const saddlepoint = saddlepoint_constant(oracle.z);
    EXPECT_NEAR(saddlepoint.plain / C, 1.0, 0.17) << oracle.z.transpose();
    EXPECT_NEAR(saddlepoint.corrected / C, 1.0, 0.026) << oracle.z.transpose();
  }
}

TEST(BinghamConstant, DerivativesAreThoseOfItsDifferences) {
  for (Vector3d const& z : {Vector3d(-3, -2, -1), Vector3d(-60, -50, -9), Vector3d(-300, -20, -2),
                            Vector3d(-900, -700, -500)}) {
    BinghamConstant const at = bingham_constant(z);
    for (int i = 0; i < 3; ++i) {
      double const step = 1e-4 * -z[i];
      BinghamConstant const up = bingham_constant(z + step * Vector3d::Unit(i));
      BinghamConstant const down = bingham_constant(z - step * Vector3d::Unit(i));
      EXPECT_NEAR((up.log_F - down.log_F) / (2.0 * step) / at.gradient[i], 1.0, 1e-6);
      Vector3d const slope = (up.gradient - down.gradient) / (2.0 * step);
      Vector3d const scale = at.gradient * at.gradient[i];
      EXPECT_LT(((slope - at.hessian.col(i)).array() / scale.array()).abs().maxCoeff(), 1e-6)
          << z.transpose();
    }
  }
}

TEST(BinghamConstant, RefusesWhatIsNoConcentration) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  double const infinity = std::numeric_limits<double>::infinity();
  for (Vector3d const& z :
       {Vector3d(-1, -2, 0), Vector3d(-2, -1, 1e-3), Vector3d(-1, 0, -1), Vector3d(nan, -1, 0),
        Vector3d(-2, nan, 0), Vector3d(-2, -1, nan), Vector3d(-infinity, -1, 0)}) {
    EXPECT_THROW((void)bingham_constant(z), std::logic_error) << z.transpose();
  }
}

TEST(LogDensity, IsOverTheSphere) {
  Eigen::Quaterniond const q = so3_exp({0.3, 0.2, -0.6});
  EXPECT_NEAR(log_density({}, q), -std::log(2.0 * pi * pi), 1e-14);
  Bingham const distribution(skew_axes(), {-9, -6, -2});
  double const C = 2.0 * pi * pi * literal_sphere_integral(distribution.parameters()).F;
  double const exponent = wxyz(q).dot(distribution.parameters() * wxyz(q));
  EXPECT_NEAR(log_density(distribution, q), exponent - std::log(C), 1e-7);
  Eigen::Quaterniond const same(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_EQ(log_density(distribution, same), log_density(distribution, q));
}

}  // namespace
}  // namespace credo::test
