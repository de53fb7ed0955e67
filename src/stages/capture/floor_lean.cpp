#include "stages/capture/floor_lean.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/plane_search.hpp"

namespace credo {
namespace {

// As of find_floor: what it takes for the floor's points.
constexpr double kMaxAngle_rad = 0.35;
constexpr double kMinUp = 0.906;  // 25 degrees
// The 95 % quantiles of the chi-square distribution with two degrees of freedom and one.
constexpr double kLikelySlope = 5.99;
constexpr double kLikelyHeight = 3.84;

double variance_m2(double depth_m) {
  double const deviation_m = 0.002 + 0.0015 * depth_m * depth_m;
  return deviation_m * deviation_m;
}

/// Sums over the floor's points, each by the inverse of its variance.
struct Moments {
  double weight = 0.0;
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread_m2 = Eigen::Matrix2d::Zero();
  /// Of points to rows.
  double points_a_row = 0.0;
};

Moments moments_of(FoundPlane const& floor, CoarseCloud const& coarse, Se3 const& T_source_camera) {
  PlaneSearchPoints const& points = coarse.search;
  Moments sums;
  std::vector<std::uint8_t> in_row(static_cast<std::size_t>(coarse.points.height()), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (floor.inliers[i] == 0) {
      continue;
    }
    Eigen::Vector3d const p =
        T_source_camera * Eigen::Vector3d(points.x[i], points.y[i], points.z[i]);
    double const weight = 1.0 / variance_m2(points.z[i]);
    sums.weight += weight;
    sums.middle_m += weight * p.head<2>();
    sums.spread_m2 += weight * p.head<2>() * p.head<2>().transpose();
    in_row[static_cast<std::size_t>(coarse.points.pixel(points.source[i]).v)] = 1;
  }
  sums.middle_m /= sums.weight;
  sums.spread_m2 = sums.spread_m2 / sums.weight - sums.middle_m * sums.middle_m.transpose();
  auto const rows = static_cast<double>(std::ranges::count(in_row, 1));
  sums.points_a_row = static_cast<double>(floor.inlier_count) / rows;
  return sums;
}

FloorLean not_level() {
  FloorLean lean;
  lean.slope.setConstant(std::numeric_limits<double>::infinity());
  return lean;
}

}  // namespace

double FloorLean::lean_rad() const {
  return std::atan(slope.norm());
}

bool FloorLean::may_be_level() const {
  return slope.allFinite() && slope.dot(slope_covariance.llt().solve(slope)) <= kLikelySlope;
}

bool FloorLean::may_be_at_zero() const {
  return height_m * height_m <= kLikelyHeight * height_deviation_m * height_deviation_m;
}

FloorLean floor_lean(Plane const& floor_camera, CoarseCloud const& coarse,
                     Se3 const& T_source_camera) {
  Plane const floor = transformed(T_source_camera, floor_camera);
  FoundPlane const found = inliers_of(floor_camera, coarse.search, kMaxAngle_rad);
  if (floor.normal.z() < kMinUp || found.inlier_count < 3) {
    return not_level();
  }
  Moments const sums = moments_of(found, coarse, T_source_camera);
  Eigen::LLT<Eigen::Matrix2d> const spread(sums.spread_m2);
  if (spread.info() != Eigen::Success) {
    return not_level();
  }
  double const variance = sums.points_a_row / sums.weight;
  FloorLean lean;
  lean.slope = -floor.normal.head<2>() / floor.normal.z();
  lean.slope_covariance = variance * spread.solve(Eigen::Matrix2d::Identity());
  lean.height_m = floor.offset_m / floor.normal.z() + lean.slope.dot(sums.middle_m);
  lean.height_deviation_m = std::sqrt(variance);
  return lean;
}

}  // namespace credo
