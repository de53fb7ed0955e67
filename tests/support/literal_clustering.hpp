#pragma once

#include <cstdint>

#include "core/cloud.hpp"
#include "core/grid.hpp"
#include "geometry/reachability/reachability.hpp"

namespace credo::test {

/// Algorithm 3 of the thesis, word for word: take the next point that has no cluster, put it in a
/// queue, and let each point of the queue bring in all points within the radius and the angle that
/// have none yet. Slow, obvious, and the oracle of connected_components: same partition, same
/// numbers.
Grid<std::int32_t> literal_components(OrganizedCloud const& cloud, NormalMap const& normals,
                                      Grid<std::uint8_t> const& active,
                                      ReachabilityLimits const& limits);

}  // namespace credo::test
