#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// A cluster of a frame in blocks.
struct SeenCluster {
  std::size_t pixel_count = 0;
  /// Places in the sight's grids, and the points there.
  std::vector<std::size_t> blocks;
  std::vector<Eigen::Vector3f> points_world;
  /// Of the surface that is seen, as if it faced the camera.
  double area_m2 = 0.0;
  /// Of the cluster in blocks (thickness.hpp).
  double thickness_blocks = 0.0;
  /// The cluster that it lies on (StuffCluster), by its place; -1 for none.
  std::int32_t lies_on = -1;
};

/// By label, from kFirstStuff on. Empty where there is no sight.
[[nodiscard]] std::vector<SeenCluster> clusters_of(Segmentation const& segmentation);

/// A thing that stands elsewhere now.
struct Move {
  std::size_t item = 0;
  std::size_t cluster = 0;
};

/// Things that have surely gone, and which of the clusters `free` each now is: near by, as large,
/// and of the same shape after ICP; each the other's best.
[[nodiscard]] std::vector<Move> moves(std::vector<StuffBelief> const& stuff,
                                      std::vector<SeenCluster> const& clusters,
                                      std::span<std::size_t const> free);

}  // namespace credo
