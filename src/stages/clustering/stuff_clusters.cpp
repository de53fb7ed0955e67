#include "stages/clustering/stuff_clusters.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/runs.hpp"

namespace credo {
namespace {

StuffCluster cluster_of(CellSums const& cells, std::size_t pixel_count, LabelCode label) {
  StuffCluster cluster;
  cluster.label = label;
  cluster.pixel_count = pixel_count;
  cluster.bounds_world = cells.bounds();
  cells.append_means(0, cluster.points_world);
  if (pixel_count > 0) {
    // Rounding must not push the centroid of a flat cluster out of its bounds.
    cluster.centroid_world =
        cells.mean().cwiseMax(cluster.bounds_world.min()).cwiseMin(cluster.bounds_world.max());
  }
  return cluster;
}

std::size_t number_of(StuffRun const& run) {
  return run.label - std::size_t{kFirstStuff};
}

}  // namespace

std::vector<StuffRun> stuff_runs(LabelMap const& labels) {
  std::vector<StuffRun> runs;
  for (int v = 0; v < labels.height(); ++v) {
    std::span<LabelCode const> const codes = labels.row(v);
    std::size_t const row = labels.index({0, v});
    for (std::size_t begin = 0, end = 0; begin < codes.size(); begin = end) {
      end = run_end(codes, begin);
      if (is_stuff(codes[begin])) {
        runs.push_back({.pixels = {row + begin, row + end}, .label = codes[begin]});
      }
    }
  }
  return runs;
}

std::vector<StuffCluster> stuff_clusters(OrganizedCloud const& cloud,
                                         std::span<StuffRun const> runs,
                                         PixelSampling const& sampling, Se3 const& T_world_camera) {
  std::size_t labels = 0;
  for (StuffRun const& run : runs) {
    labels = std::max(labels, number_of(run) + 1);
  }
  std::vector<std::size_t> pixel_counts(labels, 0);
  // Of each label where its firm runs begin among all of them; then, once they are in, where they
  // end.
  std::vector<std::size_t> places(labels + 1, 0);
  for (StuffRun const& run : runs) {
    pixel_counts[number_of(run)] += run.pixels.end - run.pixels.begin;
    places[number_of(run) + 1] += run.is_firm ? 1 : 0;
  }
  for (std::size_t i = 1; i <= labels; ++i) {
    places[i] += places[i - 1];
  }
  std::vector<PixelRun> firm(places.back());
  for (StuffRun const& run : runs) {
    if (run.is_firm) {
      firm[places[number_of(run)]++] = run.pixels;
    }
  }
  std::vector<StuffCluster> clusters(labels);
  for (std::size_t i = 0; i < labels; ++i) {
    std::size_t const begin = i > 0 ? places[i - 1] : 0;
    clusters[i] = cluster_of(sampled_cells(cloud, std::span(firm).subspan(begin, places[i] - begin),
                                           sampling, T_world_camera),
                             pixel_counts[i], static_cast<LabelCode>(kFirstStuff + i));
  }
  return clusters;
}

}  // namespace credo
