#pragma once

#include <cstdint>
#include <vector>

#include "core/se3.hpp"
#include "detector/models/search_model.hpp"
#include "detector/scenes/search_scene.hpp"
#include "detector/search/global_search.hpp"

namespace credo {

/// Where a model is near an expected pose, likeliest first; at most `max_candidates`, none of which
/// are nearly the same. Begins from poses drawn from the distribution, the more the vaguer it is;
/// where it is vaguer than `can_track` allows, the search is likely in vain.
[[nodiscard]] std::vector<PoseCandidate> search_near(SearchModel const& model,
                                                     SearchScene const& scene,
                                                     PoseDistribution const& expected_camera,
                                                     std::uint64_t seed,
                                                     std::size_t max_candidates);

/// Whether draws from a distribution come so near to the pose that one of them is caught.
[[nodiscard]] bool can_track(SearchModel const& model, PoseDistribution const& expected_camera);

}  // namespace credo
