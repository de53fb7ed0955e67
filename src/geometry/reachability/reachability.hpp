#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/cloud.hpp"
#include "core/grid.hpp"

namespace credo {

/// Two points are neighbours when they lie within this distance and this angle of each other.
struct ReachabilityLimits {
  /// Greatest distance [m] of two neighbours, inclusive.
  float radius_m = 0.05F;
  /// Greatest angle [rad] between the normals of two neighbours, exclusive.
  float max_angle_rad = 0.3F;
};

/// The limits in the form that comparisons need.
struct ReachThresholds {
  float max_squared_distance_m2 = 0.0F;
  float min_cosine = 1.0F;

  ReachThresholds() = default;
  /// Throws std::logic_error unless 0 <= radius and 0 <= angle <= pi (so NaN throws too).
  explicit ReachThresholds(ReachabilityLimits const& limits);
};

/// The one order of rounded operations in which every caller adds three products: ties fall the
/// same way in fast code, in slow code and on every instruction set. Never fused.
[[nodiscard]] inline float ordered_dot(float ax, float ay, float az, float bx, float by, float bz) {
  return ax * bx + (ay * by + az * bz);
}
[[nodiscard]] inline float ordered_squared_norm(float x, float y, float z) {
  return ordered_dot(x, y, z, x, y, z);
}

/// Are the points p and q, with normals n and m, neighbours? Symmetric in (p, n) and (q, m). False
/// where a coordinate is NaN. The test of algorithms 1 and 3 of the thesis (3.1.2, 3.3).
[[nodiscard]] inline bool within_reach(Eigen::Vector3f const& p, Eigen::Vector3f const& n,
                                       Eigen::Vector3f const& q, Eigen::Vector3f const& m,
                                       ReachThresholds const& reach) {
  return ordered_squared_norm(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()) <=
             reach.max_squared_distance_m2 &&
         ordered_dot(n.x(), n.y(), n.z(), m.x(), m.y(), m.z()) > reach.min_cosine;
}

/// Component of a pixel that takes no part.
inline constexpr std::int32_t kNoComponent = -1;

/// Connected components of the graph whose vertices are the pixels that are active (non-zero) and
/// have a finite point and normal, and whose edges are all pairs `within_reach`, however far apart
/// in the image. Components count from 0 in raster order of their first pixels; other pixels hold
/// kNoComponent.
///
/// These are the clusters of the thesis' algorithm 3, and what a set of seeds reaches in its
/// algorithm 1 is the components that hold a seed. The result is exact, not an approximation, for
/// any cloud: the image serves only to find neighbours early. Nothing is assumed about the
/// projection (registered clouds are fine) nor about the length of normals. The time grows where
/// that regularity is missing: a Kinect frame of a room takes a few milliseconds on one thread, a
/// frame whose normals are pure noise up to a hundred times that. The bound for anything: two tiles
/// of 8 x 8 pixels within reach of each other cost no more than testing all their pairs of pixels.
///
/// Throws std::logic_error where the sizes of the grids differ or the limits are not as
/// ReachThresholds demands.
[[nodiscard]] Grid<std::int32_t> connected_components(OrganizedCloud const& cloud,
                                                      NormalMap const& normals,
                                                      Grid<std::uint8_t> const& active,
                                                      ReachabilityLimits const& limits);

/// Pixels (begin, v) ... (end - 1, v) of one component.
struct ComponentRun {
  int v = 0;
  int begin = 0;
  int end = 0;
  std::int32_t component = kNoComponent;
};

/// The same components, as runs in raster order that cover exactly their pixels; a run need not be
/// the longest there is. Much smaller than the grid.
[[nodiscard]] std::vector<ComponentRun> component_runs(OrganizedCloud const& cloud,
                                                       NormalMap const& normals,
                                                       Grid<std::uint8_t> const& active,
                                                       ReachabilityLimits const& limits);

}  // namespace credo
