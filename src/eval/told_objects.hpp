#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/truth.hpp"

namespace credo {

/// Which true objects a belief's known objects are. Ids of belief and truth have nothing to do with
/// each other; types do.
class ToldObjects {
public:
  /// From the first belief and the truth of that frame: to each known object the nearest true one
  /// of its type, nearest pairs first. True objects that are left over were never told of: to the
  /// robot they are stuff.
  ToldObjects(BeliefSummary const& belief, FrameTruth const& truth);

  [[nodiscard]] bool told(std::string const& true_id) const { return told_.contains(true_id); }

  /// For each of belief.objects the position in truth.objects of the one that it can only mean:
  /// among those told of, by type, nearest pairs first, since things of one type that trade places
  /// cannot be told apart. None where the truth has none left.
  [[nodiscard]] std::vector<std::optional<std::size_t>> match(BeliefSummary const& belief,
                                                              FrameTruth const& truth) const;

private:
  std::set<std::string> told_;
};

}  // namespace credo
