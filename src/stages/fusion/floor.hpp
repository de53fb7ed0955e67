#pragma once

#include <optional>

#include "core/belief.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

/// The floor after one more look at it (thesis 4.2): the union of the points on a grid, and the
/// least-squares plane through them. Its tilt leans on the observed normals, weighted by their
/// numbers of thinned points, where the points lie too close together to tell. Without an
/// observation, or where it has no finite point or is steeper than 60 degrees, the floor as it was.
[[nodiscard]] std::optional<FloorBelief> fused_floor(std::optional<FloorBelief> known,
                                                     std::optional<FloorObservation> const& seen,
                                                     FloorFusionConfig const& config);

}  // namespace credo
