#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"
#include "stages/fusion/fusion.hpp"
#include "stages/fusion/stuff/looks.hpp"

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

/// A cluster that is nothing known. `arrived`: the frame before saw through where it is now.
struct FreeCluster {
  std::size_t cluster = 0;
  bool arrived = false;
};

/// A thing that stands elsewhere now.
struct Move {
  std::size_t item = 0;
  std::size_t cluster = 0;
  /// It stood still until now.
  bool set_out = false;
};

/// Things that stand elsewhere now, and which of the clusters `free` each is; each the other's
/// best. Those that have surely gone: what is near by, as large, and of the same shape after ICP.
/// Those that moved before, or have just come, whose place a cluster that arrived hides,
/// or that are seen through: what is near by, and nearly as large. And those that stood still until
/// a cluster arrived that hides them, which is as large, and no farther off than one walks since
/// they were seen, nor than they are wide. `looks` are at `stuff`, in its order.
[[nodiscard]] std::vector<Move> moves(std::vector<StuffBelief> const& stuff,
                                      std::vector<StuffLook> const& looks,
                                      std::vector<SeenCluster> const& clusters,
                                      std::span<FreeCluster const> free, Look const& now);

/// What is left of a cluster without the blocks that a thing explains, which stands there: `owners`
/// has of each block of the sight the place of that in the belief.
[[nodiscard]] SeenCluster without_thing(SeenCluster const& cluster, std::size_t item,
                                        Grid<std::int32_t> const& owners);

/// Whether a thing that was on its way may have walked to where the cluster is, at this place among
/// the frame's: what it should show is hidden by that, or seen through. `rest` is what of the
/// cluster may be the thing.
[[nodiscard]] bool may_have_walked_to(StuffBelief const& item, StuffLook const& look,
                                      std::size_t cluster, SeenCluster const& rest);

/// Whether a look that shows a thing says by its points that it stands elsewhere than at the one
/// before.
[[nodiscard]] bool has_moved(PointCounts const& look);

/// Of what is seen first, where the frame before saw through: it came there, which by itself makes
/// nothing that is on its way.
void count_arrival(StuffBelief& item);

/// One more look that showed the thing, and whether it had moved since the one before.
void count_look(StuffBelief& item, bool moved);

/// Whether a thing was on its way when it was last seen: it had moved at 3 of 10 of its last looks,
/// of which four to 36 count.
[[nodiscard]] bool is_on_its_way(StuffBelief const& item);

/// What was on its way and of which a frame tells nothing is less and less likely to be where it
/// was seen: the probability falls by the factor e in half a second.
void lose_sight_of(StuffBelief& item, double elapsed_s, ExistenceConfig const& config);

}  // namespace credo
