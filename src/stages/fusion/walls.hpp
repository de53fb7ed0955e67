#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/belief.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

struct FusedWalls {
  /// By ascending id.
  std::vector<WallBelief> walls;
  std::uint32_t next_id = 1;
};

/// The walls after one more look at them (thesis algorithm 5). The observations come one after the
/// other, so that two planes laid into one wall in the same frame end up as one.
///
/// Two walls match when their normals agree up to sign, the later one's centroid lies in the plane
/// of the earlier, and enough of the shorter segment lies beside the other; of several matches the
/// longest common part wins, then the lower id. Offsets are compared at that centroid: at the
/// origin, metres away from the wall, two planes that differ by a degree differ by centimetres. A
/// segment of no length overlaps in full what contains it. A wall seen from behind is the same
/// wall, unless it is thicker than the offset allows; it keeps the side from which it was first
/// seen.
///
/// The segment is that of the points beside the wall's line on z = 0, which runs below the points'
/// centroid; each end of an observation gives up the outermost few, so that a stray point does not
/// stretch a wall for ever. It only ever grows. Observations without a finite point, and planes
/// that are not finite or lie level, are passed over.
///
/// With `camera_world`, from where the observations were made, a wall's plane is fitted to all
/// points that were ever observed of it, by least squares, each by a sensor's noise at its
/// distance; without, it is the mean of the observed planes by their pixels (T), in which the tilt
/// of a look at a short piece reaches as far as the wall does.
[[nodiscard]] FusedWalls fused_walls(
    FusedWalls known, std::vector<WallObservation> const& seen, WallFusionConfig const& config,
    std::optional<Eigen::Vector3d> const& camera_world = std::nullopt);

}  // namespace credo
