#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "core/plane.hpp"
#include "core/segmentation.hpp"
#include "geometry/thinning.hpp"

// What the floor and the walls share: sets of points that grow, and planes that average.
namespace credo {

/// The mean; zero for no points.
[[nodiscard]] inline Eigen::Vector3d centroid_of(PointList const& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Vector3f const& p : points) {
    sum += p.cast<double>();
  }
  return points.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(points.size()));
}

/// How far off its surface a point may be measured, at a squared distance from the camera: a
/// Kinect's noise, and what poses are off.
[[nodiscard]] inline double surface_tolerance_m(double squared_distance_m2) {
  constexpr double kNearest_m = 0.015;
  constexpr double kPerSquareMetre = 0.0015;
  return kNearest_m + kPerSquareMetre * squared_distance_m2;
}

/// The same of the mean of many: what poses are off, and a third of the noise.
[[nodiscard]] inline double mean_tolerance_m(double squared_distance_m2) {
  double const pose_m = surface_tolerance_m(0.0);
  return pose_m + (surface_tolerance_m(squared_distance_m2) - pose_m) / 3.0;
}

/// The union on a grid, at most `max_points`: cells found after that are left out. Where nothing is
/// new it is the same set, still shared with the beliefs before.
[[nodiscard]] inline std::shared_ptr<PointList const> grown_points(
    std::shared_ptr<PointList const> const& known, PointList const& added, float spacing_m,
    int max_points) {
  auto const limit = static_cast<std::size_t>(max_points);
  if (known->size() >= limit) {
    return known;
  }
  PointList merged = merged_points(*known, added, spacing_m);
  merged.resize(std::min(merged.size(), limit));
  return merged.size() == known->size() ? known
                                        : std::make_shared<PointList const>(std::move(merged));
}

[[nodiscard]] inline bool is_finite(Plane const& plane) {
  return plane.normal.allFinite() && std::isfinite(plane.offset_m);
}

/// The plane whose signed distance is, at every point, the weighted mean of both signed distances,
/// scaled to a unit normal. So it passes between both wherever they were observed, which an average
/// of normals about some other point would not. The normals must not be opposite.
[[nodiscard]] inline Plane weighted_mean(Plane const& a, double weight_a, Plane const& b,
                                         double weight_b) {
  Eigen::Vector3d const normal = weight_a * a.normal + weight_b * b.normal;
  double const length = normal.norm();
  return {normal / length, (weight_a * a.offset_m + weight_b * b.offset_m) / length};
}

}  // namespace credo
