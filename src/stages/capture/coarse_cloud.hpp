#pragma once

#include <Eigen/Core>

#include "core/cloud.hpp"
#include "core/grid.hpp"
#include "geometry/plane_search.hpp"

namespace credo {

/// Every fourth pixel either way: enough for a floor or a wall. Camera frame.
struct CoarseCloud {
  /// NaN where invalid.
  Grid<Eigen::Vector3f> points;
  /// The valid ones, by their position in `points`, with a normal from the cross product of central
  /// differences; of no use beyond telling a floor's points from those of what stands on it.
  PlaneSearchPoints search;
};
CoarseCloud coarse_cloud(OrganizedCloud const& cloud);

/// How far a point may lie from a plane that it belongs to, generously.
[[nodiscard]] inline float noise_tolerance_m(float depth_m) {
  return 0.012F + 0.006F * depth_m * depth_m;
}

}  // namespace credo
