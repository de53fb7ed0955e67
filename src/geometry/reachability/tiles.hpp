#pragma once

#include <vector>

#include "geometry/reachability/runs.hpp"

namespace credo::reachability {

/// Unites all runs that hold neighbours, wherever in the image they lie.
void unite_all_in_reach(PointArrays const& points, LinkBits const& links,
                        std::vector<Run> const& runs, ReachThresholds const& reach,
                        DisjointSets& sets);

}  // namespace credo::reachability
