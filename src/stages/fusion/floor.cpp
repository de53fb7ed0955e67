#include "stages/fusion/floor.hpp"

#include <cstddef>
#include <memory>
#include <utility>

#include "geometry/thinning.hpp"
#include "stages/fusion/points.hpp"

namespace credo {
namespace {

/// z of the plane above or below a point of the floor plan.
double height_at(Plane const& plane, Eigen::Vector3d const& point) {
  return (plane.offset_m - plane.normal.head<2>().dot(point.head<2>())) / plane.normal.z();
}

Plane plane_of(FloorBelief const& floor) {
  Eigen::Vector3d const centroid = centroid_of(*floor.points);
  return {floor.normal,
          floor.normal.dot(Eigen::Vector3d(centroid.x(), centroid.y(), floor.height_m))};
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
  Plane plane = seen->plane_world;
  FloorBelief floor;
  if (known) {
    plane = weighted_mean(plane_of(*known), static_cast<double>(known->points->size()),
                          seen->plane_world, static_cast<double>(points.size()));
    floor = *std::move(known);
  }
  floor.points = grown_points(floor.points, points, spacing_m, config.max_points);
  floor.normal = plane.normal;
  floor.height_m = height_at(plane, centroid_of(*floor.points));
  return floor;
}

}  // namespace credo
