#include "stages/segments/segments.hpp"

#include <limits>
#include <utility>

#include "stages/segments/labels.hpp"
#include "stages/segments/limits.hpp"
#include "stages/segments/region_graph.hpp"
#include "stages/segments/region_merge.hpp"
#include "stages/segments/surface_map.hpp"

namespace credo {
namespace {

/// Numbers labels in raster order, and drops the margin.
Segments numbered(segments::PartLabels const& labels, std::size_t label_count) {
  Segments result;
  result.labels = Grid<std::int32_t>(labels.width(), labels.height());
  std::vector<std::int32_t> number_of(label_count, 0);
  for (int v = 0; v < labels.height(); ++v) {
    std::int32_t const* const row = labels.row(v);
    for (int u = 0; u < labels.width(); ++u) {
      if (row[u] == 0) {
        continue;
      }
      std::int32_t& number = number_of[static_cast<std::size_t>(row[u])];
      if (number == 0) {
        result.pixel_counts.push_back(0);
        number = static_cast<std::int32_t>(result.pixel_counts.size());
      }
      ++result.pixel_counts[static_cast<std::size_t>(number - 1)];
      result.labels[{u, v}] = number;
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
  for (int v = 0; v < labels.height(); ++v) {
    std::int32_t* const row = labels.row(v);
    for (int u = 0; u < labels.width(); ++u) {
      row[u] = root[static_cast<std::size_t>(row[u])];
    }
  }
  segments::sharpen_borders(map, graph, limits, labels);
  return numbered(labels, root.size());
}

}  // namespace credo
