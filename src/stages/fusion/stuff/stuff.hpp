#pragma once

#include <cstdint>
#include <vector>

#include "core/belief.hpp"
#include "stages/fusion/existence.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

struct FusedStuff {
  /// By ascending id.
  std::vector<StuffBelief> stuff;
  std::uint32_t next_id = 1;
};

/// The stuff after one more look at it (thesis algorithm 6): what is seen again gets one more
/// cluster and is believed more; what is not is believed less, and forgotten below the config's
/// probability; what is new is added with the prior's probability and the next id. Clusters without
/// points or bounds are passed over.
[[nodiscard]] FusedStuff fused_stuff(FusedStuff known, std::vector<StuffCluster> const& seen,
                                     ViewChange const& change, FusionConfig const& config);

}  // namespace credo
