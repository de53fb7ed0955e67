#include "geometry/reachability/reachability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "geometry/reachability/kernels.hpp"
#include "geometry/reachability/runs.hpp"
#include "geometry/reachability/tiles.hpp"

namespace credo {
namespace {

using reachability::DisjointSets;
using reachability::kMinWidth;
using reachability::LinkBits;
using reachability::PointArrays;
using reachability::Run;

PointArrays arrays_of(OrganizedCloud const& cloud, NormalMap const& normals) {
  return {.width = cloud.width(),
          .height = cloud.height(),
          .point = {cloud.x.data(), cloud.y.data(), cloud.z.data()},
          .normal = {normals.x.data(), normals.y.data(), normals.z.data()}};
}

// The same grid with columns added on the right, or taken away.
template <typename T>
Grid<T> with_width(Grid<T> const& grid, int width, T const& fill) {
  Grid<T> result(width, grid.height(), fill);
  for (int v = 0; v < grid.height(); ++v) {
    std::copy_n(grid.row(v).begin(), std::min(width, grid.width()), result.row(v).begin());
  }
  return result;
}

template <typename Vectors>
Vectors with_width(Vectors const& grid, int width) {
  Vectors result;
  result.x = with_width(grid.x, width, kNaN);
  result.y = with_width(grid.y, width, kNaN);
  result.z = with_width(grid.z, width, kNaN);
  return result;
}

// Numbers the components by their first runs, which come in raster order.
std::vector<ComponentRun> numbered(std::vector<Run> const& runs, DisjointSets& sets) {
  std::vector<ComponentRun> result(runs.size());
  std::int32_t count = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto const root = static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(i)));
    result[i] = {.v = runs[i].v,
                 .begin = runs[i].begin,
                 .end = runs[i].end,
                 .component = root == i ? count++ : result[root].component};
  }
  return result;
}

}  // namespace

ReachThresholds::ReachThresholds(ReachabilityLimits const& limits)
    : max_squared_distance_m2(limits.radius_m * limits.radius_m),
      min_cosine(std::cos(limits.max_angle_rad)) {
  bool const good_radius = limits.radius_m >= 0.0F;
  bool const good_angle =
      limits.max_angle_rad >= 0.0F && limits.max_angle_rad <= std::numbers::pi_v<float>;
  if (!good_radius || !good_angle) {
    throw std::logic_error("reachability: radius " + std::to_string(limits.radius_m) +
                           " m must be >= 0 and angle " + std::to_string(limits.max_angle_rad) +
                           " rad in [0, pi]");
  }
}

std::vector<ComponentRun> component_runs(OrganizedCloud const& cloud, NormalMap const& normals,
                                         Grid<std::uint8_t> const& active,
                                         ReachabilityLimits const& limits) {
  ReachThresholds const reach(limits);
  if (!cloud.x.same_size(normals.x) || !cloud.x.same_size(active)) {
    throw std::logic_error(
        "connected_components: cloud " + std::to_string(cloud.width()) + "x" +
        std::to_string(cloud.height()) + ", normals " + std::to_string(normals.width()) + "x" +
        std::to_string(normals.height()) + " and mask " + std::to_string(active.width()) + "x" +
        std::to_string(active.height()) + " must have one size");
  }
  if (cloud.empty()) {
    return {};
  }
  if (cloud.width() < kMinWidth) {
    return component_runs(with_width(cloud, kMinWidth), with_width(normals, kMinWidth),
                          with_width(active, kMinWidth, std::uint8_t{0}), limits);
  }
  PointArrays const points = arrays_of(cloud, normals);
  LinkBits const links = reachability::link_neighbours(points, active.data(), reach);
  std::vector<Run> const runs = reachability::find_runs(links, cloud.height());
  DisjointSets sets(runs.size());
  reachability::unite_linked_runs(links, runs, sets);
  reachability::unite_all_in_reach(points, links, runs, reach, sets);
  return numbered(runs, sets);
}

Grid<std::int32_t> connected_components(OrganizedCloud const& cloud, NormalMap const& normals,
                                        Grid<std::uint8_t> const& active,
                                        ReachabilityLimits const& limits) {
  Grid<std::int32_t> components(cloud.width(), cloud.height(), kNoComponent);
  for (ComponentRun const& run : component_runs(cloud, normals, active, limits)) {
    std::fill_n(components.row(run.v).begin() + run.begin, run.end - run.begin, run.component);
  }
  return components;
}

}  // namespace credo
