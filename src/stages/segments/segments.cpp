#include "stages/segments/segments.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "stages/segments/convexity/labels.hpp"
#include "stages/segments/convexity/limits.hpp"
#include "stages/segments/convexity/region_graph.hpp"
#include "stages/segments/convexity/region_merge.hpp"
#include "stages/segments/convexity/surface_map.hpp"
#include "stages/segments/label_runs.hpp"
#include "stages/segments/numbering.hpp"

namespace credo {
namespace {

/// Numbers what parts went into in raster order, and drops the margin.
Segments numbered(segments::PartLabels const& labels, std::vector<std::int32_t> const& root) {
  Segments result;
  result.labels = Grid<std::int32_t>::unset(labels.width(), labels.height());
  segments::Numbering numbering(root);
  segments::LabelRuns runs(labels.width());
  for (int v = 0; v < labels.height(); ++v) {
    std::span<std::int32_t const> const row(labels.row(v),
                                            static_cast<std::size_t>(labels.width()));
    runs.find(row);
    for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
      end = runs.end(begin);
      std::ranges::fill(result.labels.row(v).subspan(begin, end - begin),
                        numbering.number(row[begin], end - begin));
    }
  }
  result.pixel_counts = std::move(numbering).pixel_counts();
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
