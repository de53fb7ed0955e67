#pragma once

#include <vector>

#include "detector/pair_table.hpp"
#include "detector/polishing.hpp"
#include "detector/search_model.hpp"
#include "detector/search_scene.hpp"

namespace credo {

/// Where a model may be in a scene, likeliest first; at most `max_candidates`, none of which are
/// nearly the same (with the model's symmetry). Wherever the camera is: nothing is expected.
[[nodiscard]] std::vector<PoseCandidate> search_everywhere(SearchModel const& model,
                                                           PairTable const& pairs,
                                                           SearchScene const& scene,
                                                           std::size_t max_candidates);

}  // namespace credo
