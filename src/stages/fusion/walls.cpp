#include "stages/fusion/walls.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "geometry/thinning.hpp"
#include "stages/fusion/points.hpp"

namespace credo {
namespace {

/// The wall's line on the floor plan.
struct FloorLine {
  Eigen::Vector2d point_m;
  Eigen::Vector2d direction;

  [[nodiscard]] double along_m(Eigen::Vector2d const& p) const {
    return direction.dot(p - point_m);
  }
  [[nodiscard]] Eigen::Vector2d at(double along_m) const { return point_m + along_m * direction; }
};

/// Where the plane, at the height of `centroid`, stands above the floor.
FloorLine floor_line(Plane const& plane, Eigen::Vector3d const& centroid) {
  Eigen::Vector2d const level = plane.normal.head<2>();
  Eigen::Vector2d const point =
      centroid.head<2>() - plane.signed_distance_m(centroid) / level.squaredNorm() * level;
  return {point, Eigen::Vector2d(-level.y(), level.x()).normalized()};
}

struct Interval {
  double begin_m = 0.0;
  double end_m = 0.0;
  [[nodiscard]] double length_m() const { return end_m - begin_m; }
};

Interval interval_on(FloorLine const& line, WallBelief const& wall) {
  auto const [begin, end] =
      std::minmax({line.along_m(wall.segment_start_m), line.along_m(wall.segment_end_m)});
  return {begin, end};
}

/// The points beside a line, without the outermost ones at each end.
Interval trimmed_interval(FloorLine const& line, PointList const& points, double trim_ratio) {
  std::vector<double> along_m;
  along_m.reserve(points.size());
  for (Eigen::Vector3f const& p : points) {
    along_m.push_back(line.along_m(p.head<2>().cast<double>()));
  }
  std::sort(along_m.begin(), along_m.end());
  auto const trimmed =
      static_cast<std::size_t>(trim_ratio * static_cast<double>(along_m.size() - 1));
  return {along_m[trimmed], along_m[along_m.size() - 1 - trimmed]};
}

/// Each point counts by the variance of its depth.
PlaneSums sums_of(PointList const& points, Eigen::Vector3d const& camera_world) {
  constexpr double kNearest_m = 0.002;
  constexpr double kPerSquareMetre = 0.0015;
  PlaneSums sums;
  for (Eigen::Vector3f const& point : points) {
    Eigen::Vector3d const p = point.cast<double>();
    double const sigma_m = kNearest_m + kPerSquareMetre * (p - camera_world).squaredNorm();
    double const weight = 1.0 / (sigma_m * sigma_m);
    sums.weight += weight;
    sums.points += weight * p;
    sums.products += weight * p * p.transpose();
  }
  return sums;
}

PlaneSums operator+(PlaneSums const& a, PlaneSums const& b) {
  return {a.weight + b.weight, a.points + b.points, a.products + b.products};
}

/// The plane of least squares. Where the points form a strip narrower than a few hand's breadths,
/// `observed` decides how it is turned (ridge regression towards it, as the floor's).
Plane fitted_plane(PlaneSums const& sums, Plane const& observed) {
  constexpr double kStripM = 0.3;
  Eigen::Vector3d const mean = sums.points / sums.weight;
  Eigen::Matrix3d const spread = sums.products / sums.weight - mean * mean.transpose();
  Eigen::Matrix3d const ridge =
      kStripM * kStripM *
      (Eigen::Matrix3d::Identity() - observed.normal * observed.normal.transpose());
  Eigen::Vector3d const across =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread + ridge).eigenvectors().col(0);
  Eigen::Vector3d const normal = across.dot(observed.normal) < 0.0 ? -across : across;
  return {normal, normal.dot(mean)};
}

/// The observation as a wall of its own, without an id; none where it is no wall.
std::optional<WallBelief> as_wall(WallObservation const& seen, WallFusionConfig const& config,
                                  std::optional<Eigen::Vector3d> const& camera_world) {
  constexpr double kMinLevelNormal = 1e-3;
  if (!is_finite(seen.plane_world) ||
      !(seen.plane_world.normal.head<2>().norm() > kMinLevelNormal)) {
    return std::nullopt;
  }
  PointList points = thin_points(seen.points_world, static_cast<float>(config.point_spacing_m));
  if (points.empty()) {
    return std::nullopt;
  }
  FloorLine const line = floor_line(seen.plane_world, centroid_of(points));
  Interval const interval = trimmed_interval(line, points, config.segment_trim_ratio);
  WallBelief wall;
  if (camera_world) {
    wall.sums = sums_of(points, *camera_world);
  }
  points.resize(std::min(points.size(), static_cast<std::size_t>(config.max_points)));
  wall.plane_world = seen.plane_world;
  wall.segment_start_m = line.at(interval.begin_m);
  wall.segment_end_m = line.at(interval.end_m);
  wall.points = std::make_shared<PointList const>(std::move(points));
  wall.weight_pixels = static_cast<double>(std::max<std::size_t>(1, seen.pixel_count));
  wall.label = seen.label;
  return wall;
}

/// The common part of both segments along the known wall; none where they do not match.
std::optional<double> matching_length_m(WallBelief const& known, WallBelief const& other,
                                        WallFusionConfig const& config) {
  Plane const& plane = known.plane_world;
  if (!(plane.normal.cross(other.plane_world.normal).norm() < config.max_normal_cross)) {
    return std::nullopt;
  }
  Eigen::Vector3d const centroid = centroid_of(*other.points);
  if (!(std::abs(plane.signed_distance_m(centroid)) <= config.max_offset_m)) {
    return std::nullopt;
  }
  FloorLine const line = floor_line(plane, centroid);
  Interval const a = interval_on(line, known);
  Interval const b = interval_on(line, other);
  double const common_m = std::min(a.end_m, b.end_m) - std::max(a.begin_m, b.begin_m);
  double const shorter_m = std::min(a.length_m(), b.length_m());
  return common_m >= 0.0 && common_m >= config.min_overlap_ratio * shorter_m
             ? std::optional(common_m)
             : std::nullopt;
}

WallBelief merged_walls(WallBelief known, WallBelief const& other, WallFusionConfig const& config) {
  bool const same_side = known.plane_world.normal.dot(other.plane_world.normal) >= 0.0;
  known.plane_world = weighted_mean(known.plane_world, known.weight_pixels,
                                    same_side ? other.plane_world : other.plane_world.flipped(),
                                    other.weight_pixels);
  known.weight_pixels += other.weight_pixels;
  known.sums = known.sums + other.sums;
  if (known.sums.weight > 0.0) {
    known.plane_world = fitted_plane(known.sums, known.plane_world);
  }
  known.points = grown_points(known.points, *other.points,
                              static_cast<float>(config.point_spacing_m), config.max_points);
  FloorLine const line = floor_line(known.plane_world, centroid_of(*known.points));
  Interval const a = interval_on(line, known);
  Interval const b = interval_on(line, other);
  known.segment_start_m = line.at(std::min(a.begin_m, b.begin_m));
  known.segment_end_m = line.at(std::max(a.end_m, b.end_m));
  // Planes come largest first: of several observations the first names the wall.
  known.label = known.label ? known.label : other.label;
  return known;
}

/// Position of the wall that matches best.
std::optional<std::size_t> best_match(std::vector<WallBelief> const& walls, WallBelief const& other,
                                      WallFusionConfig const& config) {
  std::optional<std::size_t> best;
  double best_m = -1.0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    std::optional<double> const common_m = matching_length_m(walls[i], other, config);
    if (common_m && *common_m > best_m) {
      best = i;
      best_m = *common_m;
    }
  }
  return best;
}

/// Merges each wall into the first before it that it matches. A wall that has grown may match what
/// it did not before: from the start again, until nothing matches.
std::vector<WallBelief> without_duplicates(std::vector<WallBelief> walls,
                                           WallFusionConfig const& config) {
  for (std::size_t later = 1; later < walls.size();) {
    std::size_t earlier = 0;
    while (earlier < later && !matching_length_m(walls[earlier], walls[later], config)) {
      ++earlier;
    }
    if (earlier == later) {
      ++later;
      continue;
    }
    walls[earlier] = merged_walls(std::move(walls[earlier]), walls[later], config);
    walls.erase(std::next(walls.begin(), static_cast<std::ptrdiff_t>(later)));
    later = 1;
  }
  return walls;
}

}  // namespace

FusedWalls fused_walls(FusedWalls known, std::vector<WallObservation> const& seen,
                       WallFusionConfig const& config,
                       std::optional<Eigen::Vector3d> const& camera_world) {
  std::vector<WallBelief>& walls = known.walls;
  for (WallBelief& wall : walls) {
    wall.label.reset();
  }
  for (WallObservation const& observation : seen) {
    std::optional<WallBelief> wall = as_wall(observation, config, camera_world);
    if (!wall) {
      continue;
    }
    if (std::optional<std::size_t> const match = best_match(walls, *wall, config)) {
      walls[*match] = merged_walls(std::move(walls[*match]), *wall, config);
    } else {
      wall->id = known.next_id++;
      walls.push_back(*std::move(wall));
    }
  }
  if (config.merge_known) {
    walls = without_duplicates(std::move(walls), config);
  }
  return known;
}

}  // namespace credo
