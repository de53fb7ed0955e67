#include "stages/segments/segments.hpp"

#include <algorithm>
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
    for (int u = 0; u < labels.width();) {
      if (row[u] == 0) {
        ++u;
        continue;
      }
      int const begin = u;
      while (u < labels.width() && row[u] == row[begin]) {
        ++u;
      }
      std::int32_t& number = number_of[static_cast<std::size_t>(row[begin])];
      if (number == 0) {
        result.pixel_counts.push_back(0);
        number = static_cast<std::int32_t>(result.pixel_counts.size());
      }
      result.pixel_counts[static_cast<std::size_t>(number - 1)] +=
          static_cast<std::uint32_t>(u - begin);
      std::fill_n(result.labels.row(v).begin() + begin, u - begin, number);
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
    std::int32_t label = 0;
    std::int32_t into = 0;
    for (int u = 0; u < labels.width(); ++u) {
      if (row[u] != label) {
        label = row[u];
        into = root[static_cast<std::size_t>(label)];
      }
      row[u] = into;
    }
  }
  segments::sharpen_borders(map, graph, limits, labels);
  return numbered(labels, root.size());
}

}  // namespace credo
