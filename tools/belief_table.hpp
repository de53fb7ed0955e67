#pragma once

#include <string>

#include "core/belief_summary.hpp"

namespace credo {

/// A belief for people: a line on the frame, then a row for each thing, positions in metres in the
/// world frame, labels left out. Ends with a line end.
[[nodiscard]] std::string belief_table(std::string const& source, BeliefSummary const& belief);

}  // namespace credo
