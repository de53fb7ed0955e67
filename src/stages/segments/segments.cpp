#include "stages/segments/segments.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "stages/segments/label_runs.hpp"
#include "stages/segments/labels.hpp"
#include "stages/segments/limits.hpp"
#include "stages/segments/region_graph.hpp"
#include "stages/segments/region_merge.hpp"
#include "stages/segments/surface_map.hpp"

namespace credo {
namespace {

/// Numbers what parts went into in raster order, and drops the margin.
Segments numbered(segments::PartLabels const& labels, std::vector<std::int32_t> const& root) {
  Segments result;
  result.labels = Grid<std::int32_t>(labels.width(), labels.height());
  std::vector<std::int32_t> number_of(root.size(), 0);
  segments::LabelRuns runs(labels.width());
  for (int v = 0; v < labels.height(); ++v) {
    std::span<std::int32_t const> const row(labels.row(v),
                                            static_cast<std::size_t>(labels.width()));
    runs.find(row);
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < row.size(); begin = end) {
      end = runs.end(begin);
      if (row[begin] == 0) {
        continue;
      }
      auto const part = static_cast<std::size_t>(root[static_cast<std::size_t>(row[begin])]);
      std::int32_t& number = number_of[part];
      if (number == 0) {
        result.pixel_counts.push_back(0);
        number = static_cast<std::int32_t>(result.pixel_counts.size());
      }
      result.pixel_counts[static_cast<std::size_t>(number - 1)] +=
          static_cast<std::uint32_t>(end - begin);
      std::ranges::fill(result.labels.row(v).subspan(begin, end - begin), number);
    }
  }
  return result;
}

}  // namespace

Segments convex_segments(Grid<float> const& depth_m, double focal_px,
                         SegmentsConfig const& config) {
  segments::Limits const limits = segments::limits_for(focal_px, config);
  segments::SurfaceMap const map = segments::map_surfaces(depth_m, limits);
  segments::PartLabels labels = segments::grow_parts(map, limits);
  segments::RegionGraph graph = segments::region_graph(map, labels, limits);
  std::vector<std::int32_t> const root = segments::joined_parts(graph, limits);
  segments::sharpen_borders(map, graph, root, limits, labels);
  return numbered(labels, root);
}

}  // namespace credo
