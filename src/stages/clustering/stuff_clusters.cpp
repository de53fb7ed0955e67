#include "stages/clustering/stuff_clusters.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/runs.hpp"
#include "geometry/cell_sums.hpp"

namespace credo {
namespace {

struct Gathered {
  std::size_t pixel_count = 0;
  CellSums cells;
};

StuffCluster cluster_of(Gathered const& gathered, LabelCode label) {
  StuffCluster cluster;
  cluster.label = label;
  cluster.pixel_count = gathered.pixel_count;
  cluster.bounds_world = gathered.cells.bounds();
  gathered.cells.append_means(0, cluster.points_world);
  if (gathered.pixel_count > 0) {
    // Rounding must not push the centroid of a flat cluster out of its bounds.
    cluster.centroid_world = gathered.cells.mean()
                                 .cwiseMax(cluster.bounds_world.min())
                                 .cwiseMin(cluster.bounds_world.max());
  }
  return cluster;
}

// The points of pixels `begin` ... `begin + count - 1` of the image.
PointSpans points_of(OrganizedCloud const& cloud, std::size_t begin, std::size_t count) {
  return {.x = {cloud.x.data() + begin, count},
          .y = {cloud.y.data() + begin, count},
          .z = {cloud.z.data() + begin, count}};
}

}  // namespace

std::vector<StuffCluster> stuff_clusters(OrganizedCloud const& cloud, LabelMap const& labels,
                                         Grid<std::uint8_t> const& firm, Se3 const& T_world_camera,
                                         float spacing_m) {
  std::vector<Gathered> gathered;
  std::vector<std::uint8_t> const all_firm(static_cast<std::size_t>(labels.width()), 1);
  for (int v = 0; v < labels.height(); ++v) {
    std::span<LabelCode const> const codes = labels.row(v);
    std::span<std::uint8_t const> const is_firm =
        firm.empty() ? std::span<std::uint8_t const>(all_firm) : firm.row(v);
    for_each_run(codes, is_firm, [&](std::size_t begin, std::size_t end) {
      if (!is_stuff(codes[begin])) {
        return;
      }
      std::size_t const i = codes[begin] - kFirstStuff;
      while (gathered.size() <= i) {
        gathered.push_back({.cells = CellSums(spacing_m, T_world_camera)});
      }
      gathered[i].pixel_count += end - begin;
      if (is_firm[begin] != 0) {
        gathered[i].cells.add(points_of(cloud, labels.index({0, v}) + begin, end - begin));
      }
    });
  }
  std::vector<StuffCluster> clusters(gathered.size());
  for (std::size_t i = 0; i < gathered.size(); ++i) {
    clusters[i] = cluster_of(gathered[i], static_cast<LabelCode>(kFirstStuff + i));
  }
  return clusters;
}

}  // namespace credo
