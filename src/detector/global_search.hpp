#pragma once

#include <vector>

#include "detector/pair_table.hpp"
#include "detector/search_model.hpp"
#include "detector/search_scene.hpp"
#include "detector/verification.hpp"

namespace credo {

/// A pose that was refined and held against the scene.
struct Candidate {
  CameraPose pose;
  Verification verification;
  /// That it is right; set once its rivals are known.
  float probability = 0.0F;
};

/// Where a model may be in a scene, likeliest first; at most `max_candidates`, none of which are
/// nearly the same (with the model's symmetry). Wherever the camera is: nothing is expected.
[[nodiscard]] std::vector<Candidate> search_everywhere(SearchModel const& model,
                                                       PairTable const& pairs,
                                                       SearchScene const& scene,
                                                       std::size_t max_candidates);

}  // namespace credo
