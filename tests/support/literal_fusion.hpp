#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/segmentation.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo::test {

/// Algorithm 6 to the letter: every candidate pair aligned both ways, in doubles, by loops over all
/// points and Eigen's Umeyama, with no early end, on all points of the clusters (give clusters that
/// are small enough not to be thinned).
std::vector<std::optional<std::size_t>> literal_matches(std::vector<StuffCluster> const& known,
                                                        std::vector<StuffCluster> const& seen,
                                                        StuffFusionConfig const& config);

}  // namespace credo::test
