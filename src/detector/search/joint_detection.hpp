#pragma once

#include <optional>
#include <vector>

#include "detector/scenes/search_scene.hpp"
#include "detector/search/global_search.hpp"
#include "detector/search/rivalry.hpp"

namespace credo {

/// The poses that explain the scene best together (MOPE, thesis 2.2): one of each object at most,
/// and no pixel twice. How likely each
/// is depends on its rivals for the same pixels (rivalry.hpp). Then each is held against the scene
/// again, with what the better ones explain standing before it, so that its probability never rises
/// by the others. Those below `min_probability`, before or after, are none.
[[nodiscard]] std::vector<std::optional<PoseCandidate>> choose_jointly(
    std::vector<ObjectCandidates> const& objects, SearchScene const& scene, float min_probability);

/// What those of them that are at least so likely explain together.
[[nodiscard]] ClaimedPixels explained_by(std::vector<std::optional<PoseCandidate>> const& found,
                                         SearchScene const& scene, float least_probability);

}  // namespace credo
