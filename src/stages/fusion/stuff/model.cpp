#include "stages/fusion/stuff/model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace credo {
namespace {

constexpr double kCellsAcross = 25.0;
constexpr double kFinest_m = 0.008;
constexpr double kCoarsest_m = 0.040;
constexpr std::size_t kMostPoints = 4000;
constexpr std::size_t kFewestPoints = 20;
constexpr float kMissedTooOften = 2.0F;

/// 21 bits an axis.
std::uint64_t cell_of(Eigen::Vector3f const& point, float spacing_m) {
  constexpr float kLast = (1 << 20) - 1;
  auto const along = [&](float coordinate_m) {
    float const place = std::clamp(coordinate_m / spacing_m, -kLast - 1.0F, kLast);
    auto const towards_zero = static_cast<std::int32_t>(place);
    // std::floor is a call where the processor is not told to have it.
    std::int32_t const cell = towards_zero - (static_cast<float>(towards_zero) > place ? 1 : 0);
    return static_cast<std::uint64_t>(cell + (1 << 20));
  };
  return (along(point.x()) << 42U) | (along(point.y()) << 21U) | along(point.z());
}

/// A point, by its place in a list, and its cell.
struct Place {
  std::uint64_t cell = 0;
  std::size_t point = 0;
};

Eigen::Vector3f const& position_of(Eigen::Vector3f const& point) {
  return point;
}
Eigen::Vector3f const& position_of(SurfacePoint const& point) {
  return point.p_world;
}

/// By ascending cell; those of one cell as they were listed.
template <typename Point>
std::vector<Place> by_cell(std::span<Point const> points, float spacing_m) {
  std::vector<Place> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    places[i] = {cell_of(position_of(points[i]), spacing_m), i};
  }
  std::ranges::sort(places, [](Place const& a, Place const& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.point < b.point;
  });
  return places;
}

StuffModel with_room_for(std::size_t points, float spacing_m) {
  StuffModel model;
  model.spacing_m = spacing_m;
  model.cells.reserve(points);
  model.points.reserve(points);
  return model;
}

/// Points of one cell become their mean, one point that weighs as much as the heaviest of them.
StuffModel thinned(std::span<SurfacePoint const> points, float spacing_m) {
  std::vector<Place> const places = by_cell(points, spacing_m);
  StuffModel model = with_room_for(points.size(), spacing_m);
  for (std::size_t i = 0; i < places.size();) {
    std::size_t const begin = i;
    SurfacePoint mean = points[places[begin].point];
    for (++i; i < places.size() && places[i].cell == places[begin].cell; ++i) {
      SurfacePoint const& other = points[places[i].point];
      mean.p_world += other.p_world;
      mean.weight = std::max(mean.weight, other.weight);
      mean.missed = std::min(mean.missed, other.missed);
      mean.apart = std::min(mean.apart, other.apart);
    }
    mean.p_world /= static_cast<float>(i - begin);
    model.cells.push_back(places[begin].cell);
    model.points.push_back(mean);
  }
  return model;
}

/// The same for points that are seen for the first time.
StuffModel of_points(std::span<Eigen::Vector3f const> points_world, float spacing_m) {
  std::vector<Place> const places = by_cell(points_world, spacing_m);
  StuffModel model = with_room_for(points_world.size(), spacing_m);
  for (std::size_t i = 0; i < places.size();) {
    std::size_t const begin = i;
    Eigen::Vector3f sum = points_world[places[begin].point];
    for (++i; i < places.size() && places[i].cell == places[begin].cell; ++i) {
      sum += points_world[places[i].point];
    }
    model.cells.push_back(places[begin].cell);
    model.points.push_back({.p_world = sum / static_cast<float>(i - begin)});
  }
  return model;
}

StuffModel within_limit(StuffModel model) {
  while (model.points.size() > kMostPoints) {
    model = thinned(model.points, model.spacing_m * 1.5F);
  }
  return model;
}

SurfacePoint fused(SurfacePoint point, SurfacePoint const& seen) {
  point.weight = std::min(point.weight + 1.0F, kMostWeight);
  point.p_world += (seen.p_world - point.p_world) / point.weight;
  return point;
}

}  // namespace

std::uint64_t neighbour_cell(std::uint64_t cell, std::int64_t dx, std::int64_t dy,
                             std::int64_t dz) {
  return cell + (static_cast<std::uint64_t>(dx) << 42U) + (static_cast<std::uint64_t>(dy) << 21U) +
         static_cast<std::uint64_t>(dz);
}

StuffModel new_model(std::span<Eigen::Vector3f const> points_world, double area_m2) {
  double const spacing_m =
      std::clamp(std::sqrt(std::max(area_m2, 0.0)) / kCellsAcross, kFinest_m, kCoarsest_m);
  return within_limit(of_points(points_world, static_cast<float>(spacing_m)));
}

StuffModel fused_model(StuffModel const& model, std::span<Eigen::Vector3f const> points_world) {
  StuffModel const seen = of_points(points_world, model.spacing_m);
  StuffModel both = with_room_for(model.cells.size() + seen.cells.size(), model.spacing_m);
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < model.cells.size() || j < seen.cells.size()) {
    bool const known =
        i < model.cells.size() && (j == seen.cells.size() || model.cells[i] <= seen.cells[j]);
    bool const again =
        j < seen.cells.size() && (i == model.cells.size() || seen.cells[j] <= model.cells[i]);
    both.cells.push_back(known ? model.cells[i] : seen.cells[j]);
    both.points.push_back(known && again ? fused(model.points[i], seen.points[j])
                          : known        ? model.points[i]
                                         : seen.points[j]);
    i += known ? 1 : 0;
    j += again ? 1 : 0;
  }
  return within_limit(std::move(both));
}

StuffModel joined_model(StuffModel const& model, StuffModel const& other) {
  std::vector<SurfacePoint> points = model.points;
  points.insert(points.end(), other.points.begin(), other.points.end());
  for (SurfacePoint& point : points) {
    point.apart = 0.0F;
  }
  return within_limit(thinned(points, model.spacing_m));
}

StuffModel carved_model(StuffModel model) {
  std::vector<std::uint8_t> gone(model.points.size());
  std::ranges::transform(model.points, gone.begin(), [](SurfacePoint const& point) {
    return point.missed >= kMissedTooOften ? 1 : 0;
  });
  return without(std::move(model), gone);
}

StuffModel without(StuffModel model, std::span<std::uint8_t const> gone) {
  std::vector<std::uint32_t> order(model.points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::erase_if(order, [&](std::uint32_t i) { return gone[i] != 0; });
  if (order.size() == model.points.size() || order.size() < kFewestPoints) {
    return model;
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    model.cells[k] = model.cells[order[k]];
    model.points[k] = model.points[order[k]];
  }
  model.cells.resize(order.size());
  model.points.resize(order.size());
  return model;
}

StuffCluster cluster_of(StuffModel const& model, LabelCode label, std::size_t pixel_count) {
  StuffCluster cluster;
  cluster.label = label;
  cluster.pixel_count = pixel_count;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  cluster.points_world.reserve(model.points.size());
  for (SurfacePoint const& point : model.points) {
    cluster.points_world.push_back(point.p_world);
    cluster.bounds_world.extend(point.p_world);
    sum += point.p_world.cast<double>();
  }
  if (!model.points.empty()) {
    cluster.centroid_world = (sum / static_cast<double>(model.points.size()))
                                 .cast<float>()
                                 .cwiseMax(cluster.bounds_world.min())
                                 .cwiseMin(cluster.bounds_world.max());
  }
  return cluster;
}

}  // namespace credo
