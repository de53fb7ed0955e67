#pragma once

#include <vector>

#include "detector/facets.hpp"
#include "detector/pair_proposals.hpp"
#include "detector/search_model.hpp"
#include "detector/search_scene.hpp"
#include "detector/verification.hpp"

namespace credo {

/// Poses that lay a flat piece of the model on a flat piece of the scene: side along side, and
/// corner on corner or middle on middle. For boxes and tables, whose points all look alike. Only
/// where the scene's piece is no larger than the model's, and not of a segment that is `explained`
/// (empty, or as large as the image) by half.
[[nodiscard]] std::vector<Proposal> propose_by_facets(SearchModel const& model,
                                                      SearchScene const& scene,
                                                      ClaimedPixels const& explained = {});

}  // namespace credo
