#pragma once

#include <optional>
#include <string>

#include "history/history.hpp"

namespace credo {

/// What a run's config bounds; none where it is not known.
struct BeliefLimits {
  /// On |log-odds|.
  std::optional<double> max_log_odds;
  /// Stuff is forgotten below it.
  std::optional<double> min_probability;
};

/// SVG, three strips over the time since the run's first frame: the probability that the thing is
/// there, its log-odds, and of the points of its surface how many the frames say what of. Behind
/// the first two each span has the colour of its evidence.
[[nodiscard]] std::string history_plot(ThingHistory const& history, BeliefLimits const& limits);

}  // namespace credo
