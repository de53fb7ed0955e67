#pragma once

#include <vector>

#include "detector/models/pair_table.hpp"
#include "detector/models/search_model.hpp"
#include "detector/poses/polishing.hpp"
#include "detector/scenes/search_scene.hpp"
#include "detector/search/pair_proposals.hpp"

namespace credo {

/// Where a model may be in a scene, likeliest first; at most `max_candidates`, none of which are
/// nearly the same (with the model's symmetry). Wherever the camera is: nothing is expected. What
/// is `explained` by other objects (empty, or as large as the image) proposes no poses, speaks
/// against those that lie on it, and is no more than half of what a pose explains.
[[nodiscard]] std::vector<PoseCandidate> search_everywhere(SearchModel const& model,
                                                           PairTable const& pairs,
                                                           SearchScene const& scene,
                                                           std::size_t max_candidates,
                                                           ClaimedPixels const& explained = {});

/// A second look, with half the survivors, for what a search everywhere did not find: where other
/// objects are known by now, neither they nor poses that lie on them crowd out the right one any
/// more. All of what was found before, and at most `max_candidates` more that are nearly none of
/// it; likeliest first.
[[nodiscard]] std::vector<PoseCandidate> search_again(SearchModel const& model,
                                                      PairTable const& pairs,
                                                      SearchScene const& scene,
                                                      std::vector<PoseCandidate> found_before,
                                                      ClaimedPixels const& explained,
                                                      std::size_t max_candidates);

/// What both of them begin with: poses that pairs of points or flat pieces speak for.
[[nodiscard]] std::vector<Proposal> propose_everywhere(SearchModel const& model,
                                                       PairTable const& pairs,
                                                       SearchScene const& scene,
                                                       ClaimedPixels const& explained);

/// `search_everywhere` among other proposals, whatever they come from.
[[nodiscard]] std::vector<PoseCandidate> search_among(SearchModel const& model,
                                                      std::vector<Proposal> const& proposals,
                                                      SearchScene const& scene,
                                                      std::size_t max_candidates,
                                                      ClaimedPixels const& explained = {});

/// `search_again` among other proposals.
[[nodiscard]] std::vector<PoseCandidate> search_again_among(SearchModel const& model,
                                                            std::vector<Proposal> const& proposals,
                                                            SearchScene const& scene,
                                                            std::vector<PoseCandidate> found_before,
                                                            ClaimedPixels const& explained,
                                                            std::size_t max_candidates);

}  // namespace credo
