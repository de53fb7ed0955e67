#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/segmentation.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

/// For each known cluster, the position of the seen one that is the same thing, or none (thesis
/// algorithm 6). No cluster is matched twice.
///
/// Pairs whose bounding boxes overlap are aligned by ICP both ways. A known and a seen cluster
/// match when, by the sum of the squared distances, of all seen clusters as the source this one
/// fits the known one best, and of all known clusters as the source this one fits the seen one
/// best; ties: the seen cluster of the lower label, the earlier known one. With limits to RMS and
/// displacement, a pair must hold them both ways: a small cluster always lies well within a large
/// one, but not the large one within the small.
[[nodiscard]] std::vector<std::optional<std::size_t>> match_clusters(
    std::span<StuffCluster const* const> known, std::span<StuffCluster const> seen,
    StuffFusionConfig const& config);

}  // namespace credo
