#include "geometry/ray_plane_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

namespace credo {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// 1.3 m below a camera that is pitched and rolled.
Plane floor_plane() {
  return {Eigen::Vector3d(-0.1, -0.85, -0.45).normalized(), -1.3};
}

/// Where the rays of a grid of pixels meet the plane, 6 m away at most, with that error in inverse
/// depth.
Points seen_points(Plane const& plane, double sigma_per_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  Points points;
  for (int v = 0; v < 240; v += 4) {
    for (int u = 0; u < 320; u += 4) {
      Eigen::Vector3d const ray((u - 159.5) / 262.0, (v - 119.5) / 262.0, 1.0);
      double const inverse = plane.normal.dot(ray) / plane.offset_m;
      if (inverse > 1.0 / 6.0) {
        points.push_back(ray / (inverse + sigma_per_m * noise(random)));
      }
    }
  }
  return points;
}

RayPlaneFit fit_of(Points const& points) {
  RayPlaneFit fit;
  for (Eigen::Vector3d const& p : points) {
    fit.add(p);
  }
  return fit;
}

double angle_between(Eigen::Vector3d const& a, Eigen::Vector3d const& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Tilt by two angles and a shift, about a plane.
Plane moved(Plane const& plane, Eigen::Vector3d const& by) {
  Eigen::Vector3d const side = plane.normal.unitOrthogonal();
  Eigen::Vector3d const normal =
      (plane.normal + by.x() * side + by.y() * plane.normal.cross(side)).normalized();
  return {normal, plane.offset_m + by.z()};
}

/// The slow twin: squared distances, each weighed by 1 / (z d)^2, least by Gauss-Newton on numeric
/// derivatives.
Plane by_weighted_distances(Points const& points, Plane plane) {
  for (int round = 0; round < 30; ++round) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (Eigen::Vector3d const& p : points) {
      auto const weighted = [&](Eigen::Vector3d const& by) {
        Plane const at = moved(plane, by);
        return at.signed_distance_m(p) / (p.z() * at.offset_m);
      };
      constexpr double kStep = 1e-6;
      Eigen::Vector3d slope;
      for (int i = 0; i < 3; ++i) {
        slope[i] = (weighted(kStep * Eigen::Vector3d::Unit(i)) -
                    weighted(-kStep * Eigen::Vector3d::Unit(i))) /
                   (2.0 * kStep);
      }
      squares += slope * slope.transpose();
      right -= weighted(Eigen::Vector3d::Zero()) * slope;
    }
    plane = moved(plane, squares.ldlt().solve(right));
  }
  return plane;
}

/// Total least squares without regard to how a depth camera errs.
Plane by_plain_distances(Points const& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (Eigen::Vector3d const& p : points) {
    mean += p / static_cast<double>(points.size());
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (Eigen::Vector3d const& p : points) {
    scatter += (p - mean) * (p - mean).transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const solver(scatter);
  Eigen::Vector3d const normal = solver.eigenvectors().col(0);
  Plane const plane{normal, normal.dot(mean)};
  return plane.offset_m > 0.0 ? plane.flipped() : plane;
}

TEST(RayPlaneFit, FindsAnExactPlane) {
  Plane const truth = floor_plane();
  Plane const found = fit_of(seen_points(truth, 0.0, 1)).plane().value();
  EXPECT_NEAR((found.normal - truth.normal).norm(), 0.0, 1e-12);
  EXPECT_NEAR(found.offset_m, truth.offset_m, 1e-12);
}

TEST(RayPlaneFit, IsTheLeastSquaresOfDistancesWeighedByTheirNoise) {
  Points const points = seen_points(floor_plane(), 0.01, 2);
  Plane const fast = fit_of(points).plane().value();
  Plane const slow = by_weighted_distances(points, floor_plane());
  // Numeric derivatives leave as much.
  EXPECT_NEAR((fast.normal - slow.normal).norm(), 0.0, 1e-8);
  EXPECT_NEAR(fast.offset_m, slow.offset_m, 1e-8);
}

TEST(RayPlaneFit, IsNotBiasedByNoiseThatGrowsWithDistance) {
  // Three times a Kinect's noise, so that a bias shows; 20 draws leave a quarter of a draw's error.
  Plane const truth = floor_plane();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d plain_normal = Eigen::Vector3d::Zero();
  double offset_m = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Points const points = seen_points(truth, 0.009, seed);
    Plane const found = fit_of(points).plane().value();
    normal += found.normal / 20.0;
    offset_m += found.offset_m / 20.0;
    plain_normal += by_plain_distances(points).normal / 20.0;
  }
  EXPECT_LT(angle_between(normal, truth.normal), 2e-4);
  EXPECT_NEAR(offset_m, truth.offset_m, 5e-4);
  EXPECT_GT(angle_between(plain_normal, truth.normal), 1e-3) << "or the weights are of no use";
}

TEST(RayPlaneFit, AddsUp) {
  Points const points = seen_points(floor_plane(), 0.01, 3);
  auto const middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 3);
  RayPlaneFit sum = fit_of({points.begin(), middle});
  sum.add(fit_of({middle, points.end()}));
  EXPECT_EQ(sum.point_count(), points.size());
  Plane const whole = fit_of(points).plane().value();
  EXPECT_NEAR((sum.plane().value().normal - whole.normal).norm(), 0.0, 1e-12);
  EXPECT_NEAR(sum.plane().value().offset_m, whole.offset_m, 1e-12);
}

TEST(RayPlaneFit, HoldsADirection) {
  Eigen::Vector3d const up = floor_plane().normal;
  // A wall that leans by 0.05: what is told is the best of those that do not.
  Eigen::Vector3d const level = up.cross(Eigen::Vector3d(0.9, 0, 0.3)).normalized();
  Plane const wall{(level + 0.05 * up).normalized() * (level.z() > 0 ? -1.0 : 1.0), -2.5};
  Points const points = seen_points(wall, 0.003, 4);
  Plane const found = fit_of(points).plane_along(up).value();
  EXPECT_NEAR(found.normal.dot(up), 0.0, 1e-12);
  EXPECT_LT(found.offset_m, 0.0);
  auto const cost = [&](double turn_rad, double shift_m) {
    Plane const other{Eigen::AngleAxisd(turn_rad, up) * found.normal, found.offset_m + shift_m};
    double sum = 0.0;
    for (Eigen::Vector3d const& p : points) {
      sum += std::pow(inverse_depth_error_per_m(other, p), 2);
    }
    return sum;
  };
  for (double const side : {-1.0, 1.0}) {
    EXPECT_GT(cost(side * 1e-4, 0.0), cost(0.0, 0.0));
    EXPECT_GT(cost(0.0, side * 1e-4), cost(0.0, 0.0));
    EXPECT_GT(cost(side * 1e-4, side * 1e-4), cost(0.0, 0.0));
    EXPECT_GT(cost(side * 1e-4, -side * 1e-4), cost(0.0, 0.0));
  }
}

TEST(RayPlaneFit, HasNoPlaneWherePointsSpanNone) {
  EXPECT_FALSE(RayPlaneFit().plane());
  EXPECT_FALSE(RayPlaneFit().plane_along(Eigen::Vector3d::UnitY()));
  EXPECT_FALSE(fit_of({{0, 0, 1}, {0.5, 0, 1}}).plane());
  EXPECT_FALSE(fit_of({{0, 1, 1}, {0.5, 1, 1}, {1, 1, 1}, {-2, 1, 1}}).plane()) << "on a line";
  EXPECT_FALSE(fit_of({{1, 0, 1}, {1, 0, 2}, {1, 0, 3}, {2, 0, 3}}).plane())
      << "through the camera";
}

TEST(InverseDepthError, IsPositiveBeforeThePlane) {
  Plane const wall{-Eigen::Vector3d::UnitZ(), -2.0};
  EXPECT_NEAR(inverse_depth_error_per_m(wall, {0.3, 0.2, 2.0}), 0.0, 1e-12);
  EXPECT_NEAR(inverse_depth_error_per_m(wall, {0.3, 0.2, 1.0}), 0.5, 1e-12);
  EXPECT_NEAR(inverse_depth_error_per_m(wall, {0.3, 0.2, 4.0}), -0.25, 1e-12);
}

}  // namespace
}  // namespace credo
