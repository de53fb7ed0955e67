#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "history/history.hpp"

namespace credo {

/// Some successive frames of a history as one.
struct HistoryColumn {
  /// After the last of them.
  double probability = 0.0;
  /// What most of them had; of those that as many had, the last.
  Evidence evidence = Evidence::kNotSeen;
};

/// From the first frame of a history to the last, a column each or as many to each as it takes to
/// have `most` columns, at least 1; none where the thing was not believed.
[[nodiscard]] std::vector<std::optional<HistoryColumn>> columns_of(ThingHistory const& history,
                                                                   std::size_t most);

}  // namespace credo
