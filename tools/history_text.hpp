#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "history/history.hpp"

namespace credo {

/// A thing's history for people: where it begins and ends, a row for each span, and a plot of its
/// probability, marked by evidence and, where wanted, in colour. Ends with a line end.
[[nodiscard]] std::string history_text(ThingHistory const& history, bool in_color);

/// A row for each thing: its first and last frame, its probability then, how far its log-odds
/// travelled, and what happened last. In the order given.
[[nodiscard]] std::string histories_table(std::vector<ThingHistory> const& histories);

/// The same for scripts: an object, and a list of such objects without their spans.
[[nodiscard]] std::string history_json(ThingHistory const& history);
[[nodiscard]] std::string histories_json(std::vector<ThingHistory> const& histories);

}  // namespace credo
