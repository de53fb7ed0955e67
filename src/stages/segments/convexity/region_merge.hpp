#pragma once

#include <cstdint>
#include <vector>

#include "stages/segments/convexity/labels.hpp"
#include "stages/segments/convexity/limits.hpp"
#include "stages/segments/convexity/region_graph.hpp"

namespace credo::segments {

/// Joins parts across borders that no crease, jump or step holds apart, weakest border first; of
/// equals that of the lower labels. The result names for each label the one that it went into;
/// `graph.sizes` become those of the joined parts.
[[nodiscard]] std::vector<std::int32_t> joined_parts(RegionGraph& graph, Limits const& limits);

/// Gives pixels at the samples on the borders of large parts to the side whose plane fits them
/// better by more than a quantum. `labels` are those before joining, `root` says what each went
/// into; `graph.sizes` are those after.
void sharpen_borders(SurfaceMap const& map, RegionGraph const& graph,
                     std::vector<std::int32_t> const& root, Limits const& limits,
                     PartLabels& labels);

}  // namespace credo::segments
