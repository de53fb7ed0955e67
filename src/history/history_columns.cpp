#include "history/history_columns.hpp"

#include <algorithm>
#include <map>

namespace credo {

std::vector<std::optional<HistoryColumn>> columns_of(ThingHistory const& history,
                                                     std::size_t most) {
  std::size_t const first = history.moments.front().at.position;
  std::size_t const frames = history.moments.back().at.position - first + 1;
  std::size_t const count = std::min(frames, std::max<std::size_t>(most, 1));
  std::vector<std::optional<HistoryColumn>> columns(count);
  std::vector<std::map<Evidence, std::size_t>> had(count);
  for (Moment const& moment : history.moments) {
    std::size_t const column = (moment.at.position - first) * count / frames;
    std::size_t const times = ++had[column][moment.evidence];
    HistoryColumn& shown = columns[column] ? *columns[column] : columns[column].emplace();
    shown.probability = moment.probability;
    if (times >= had[column][shown.evidence]) {
      shown.evidence = moment.evidence;
    }
  }
  return columns;
}

}  // namespace credo
