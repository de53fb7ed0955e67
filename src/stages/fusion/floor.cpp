#include "stages/fusion/floor.hpp"

#include <Eigen/LU>
#include <cstddef>
#include <memory>
#include <utility>

#include "geometry/thinning.hpp"
#include "stages/fusion/points.hpp"

namespace credo {
namespace {

/// z gained along x and along y.
Eigen::Vector2d slope_of(Eigen::Vector3d const& normal) {
  return -normal.head<2>() / normal.z();
}

Eigen::Vector3d normal_of(Eigen::Vector2d const& slope) {
  return Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
}

/// The slope of the least-squares plane through the points: across places that lie far apart they
/// tell it better than any single look, whose small error in tilt grows with distance. Where they
/// form a strip narrower than a few hand's breadths, `observed` decides instead (ridge regression
/// towards it).
Eigen::Vector2d fitted_slope(PointList const& points, Eigen::Vector3d const& centroid,
                             Eigen::Vector2d const& observed) {
  constexpr double kStripM = 0.3;
  Eigen::Matrix2d level = Eigen::Matrix2d::Zero();
  Eigen::Vector2d rise = Eigen::Vector2d::Zero();
  for (Eigen::Vector3f const& point : points) {
    Eigen::Vector3d const p = point.cast<double>() - centroid;
    level += p.head<2>() * p.head<2>().transpose();
    rise += p.z() * p.head<2>();
  }
  double const ridge = static_cast<double>(points.size()) * kStripM * kStripM;
  return (level + ridge * Eigen::Matrix2d::Identity()).inverse() * (rise + ridge * observed);
}

}  // namespace

std::optional<FloorBelief> fused_floor(std::optional<FloorBelief> known,
                                       std::optional<FloorObservation> const& seen,
                                       FloorFusionConfig const& config) {
  constexpr double kMinUpward = 0.5;
  if (!seen || !is_finite(seen->plane_world) || seen->plane_world.normal.z() < kMinUpward) {
    return known;
  }
  auto const spacing_m = static_cast<float>(config.point_spacing_m);
  PointList const points = thin_points(seen->points_world, spacing_m);
  if (points.empty()) {
    return known;
  }
  FloorBelief floor;
  Eigen::Vector2d observed = slope_of(seen->plane_world.normal);
  if (known) {
    auto const weight_known = static_cast<double>(known->points->size());
    auto const weight_seen = static_cast<double>(points.size());
    observed = (weight_known * slope_of(known->normal) + weight_seen * observed) /
               (weight_known + weight_seen);
    floor = *std::move(known);
  }
  floor.points = grown_points(floor.points, points, spacing_m, config.max_points);
  Eigen::Vector3d const centroid = centroid_of(*floor.points);
  floor.normal = normal_of(fitted_slope(*floor.points, centroid, observed));
  floor.height_m = centroid.z();
  return floor;
}

}  // namespace credo
