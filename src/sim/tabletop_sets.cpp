#include "sim/tabletop_sets.hpp"

#include <algorithm>

namespace credo {

std::optional<TabletopSet> tabletop_set(std::string_view name) {
  auto const* const found = std::ranges::find(kTabletopSets, name, &TabletopSet::name);
  return found == kTabletopSets.end() ? std::nullopt : std::optional(*found);
}

std::vector<TabletopScene> make_scenes(TabletopSet const& set, ObjectModels const& models) {
  TabletopMaker const maker(models);
  std::vector<TabletopScene> scenes;
  for (int i = 0; i < set.count; ++i) {
    std::string const number = i < 10 ? "0" + std::to_string(i) : std::to_string(i);
    scenes.push_back(
        maker.make(set.kind, std::string(set.name) + "-" + number, set.first_seed + i));
  }
  return scenes;
}

}  // namespace credo
