#pragma once

#include <vector>

#include "detector/models/search_model.hpp"
#include "detector/poses/verification.hpp"
#include "detector/scenes/facets.hpp"
#include "detector/scenes/search_scene.hpp"
#include "detector/search/pair_proposals.hpp"

namespace credo {

/// Poses that lay a flat piece of the model on a flat piece of the scene: side along side, and
/// corner on corner or middle on middle. For boxes and tables, whose points all look alike. Only
/// where the scene's piece is no larger than the model's, and not of a segment that is `explained`
/// (empty, or as large as the image) by half.
[[nodiscard]] std::vector<Proposal> propose_by_facets(SearchModel const& model,
                                                      SearchScene const& scene,
                                                      ClaimedPixels const& explained = {});

}  // namespace credo
