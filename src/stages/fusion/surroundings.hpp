#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

/// What a frame says of the floor and of the walls that were known before it, by their points (at
/// most 1000 of each, spread over all).
struct WallLook {
  std::uint32_t id = 0;
  PointCounts points;
};
struct SurroundingsLook {
  std::optional<PointCounts> floor;
  std::vector<WallLook> walls;
};
[[nodiscard]] SurroundingsLook look_around(std::optional<FloorBelief> const& floor,
                                           std::vector<WallBelief> const& walls,
                                           Segmentation const& segmentation);

/// How the look moves the probability that the floor is there. What the frame has a floor in is
/// seen; else the points decide, as for stuff (finding_of). None once it is not believed any more.
/// A floor that the frame was the first to show begins with `new_probability`.
[[nodiscard]] std::optional<FloorBelief> believed_floor(std::optional<FloorBelief> floor,
                                                        std::optional<PointCounts> const& look,
                                                        Segmentation const& segmentation,
                                                        FusionConfig const& config);

/// The same for walls; those that are not believed any more are left out.
[[nodiscard]] std::vector<WallBelief> believed_walls(std::vector<WallBelief> walls,
                                                     std::vector<WallLook> const& looks,
                                                     Segmentation const& segmentation,
                                                     FusionConfig const& config);

/// The thesis' rule: floor and walls are there once they were seen.
void take_for_granted(BeliefState& belief, Segmentation const& segmentation,
                      FusionConfig const& config);

}  // namespace credo
