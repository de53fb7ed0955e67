#pragma once

#include <vector>

#include "detector/search/global_search.hpp"

namespace credo {

/// The poses that one object may have.
struct ObjectCandidates {
  /// Never null.
  SearchModel const* model = nullptr;
  std::vector<PoseCandidate> candidates;
};

/// By how much a candidate's log-odds are above those of the best other one that explains mostly
/// the same pixels; from -6 to 6, and 6 where there is none.
struct Lead {
  /// Among the other poses of the same object,
  float over_own = 6.0F;
  /// and among all other objects.
  float over_others = 6.0F;
};

/// One a candidate, in their order.
[[nodiscard]] std::vector<std::vector<Lead>> leads_of(std::vector<ObjectCandidates> const& objects,
                                                      int width_px);

/// That a candidate is right, knowing its rivals: its log-odds alone, and its leads.
[[nodiscard]] float probability_among(float log_odds, Lead const& lead);

}  // namespace credo
