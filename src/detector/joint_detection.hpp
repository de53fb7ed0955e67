#pragma once

#include <optional>
#include <vector>

#include "detector/global_search.hpp"
#include "detector/search_model.hpp"
#include "detector/search_scene.hpp"

namespace credo {

/// The poses that one object may have.
struct ObjectCandidates {
  /// Never null.
  SearchModel const* model = nullptr;
  std::vector<Candidate> candidates;
};

/// The poses that explain the scene best together (MOPE, thesis 2.2): one of each object at most,
/// and no pixel twice. Then each is held against the scene again, with what the better ones explain
/// standing before it, so that its probability never rises by the others. Those below
/// `min_probability`, before or after, are none.
[[nodiscard]] std::vector<std::optional<Candidate>> choose_jointly(
    std::vector<ObjectCandidates> const& objects, SearchScene const& scene, float min_probability);

}  // namespace credo
