#include "stages/capture/wall_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

namespace credo {
namespace {

constexpr std::size_t kFramesSearched = 5;  // evenly over all: noise and passers-by differ
constexpr int kMaxPlanes = 16;              // largest first; a wall is not among the crumbs
constexpr double kMaxAngle_rad = 0.35;      // of a point's normal to its plane
constexpr double kMaxLean = 0.1;            // of the normal: as of a wall in thesis 3.2
constexpr double kMaxShareBehind = 0.2;     // of its own points: a wall may have a door
constexpr double kCell_m = 0.1;
constexpr double kLeastArea_m2 = 0.5;
constexpr double kLeastWidth_m = 0.5;

/// Points clear of the floor, of some of the frames.
PlaneSearchPoints points_above(std::span<PlaneSearchPoints const> frames, Plane const& floor) {
  PlaneSearchPoints above;
  std::size_t const step = std::max<std::size_t>(1, frames.size() / kFramesSearched);
  for (std::size_t f = 0; f < frames.size(); f += step) {
    PlaneSearchPoints const& all = frames[f];
    for (std::size_t i = 0; i < all.size(); ++i) {
      Eigen::Vector3f const point(all.x[i], all.y[i], all.z[i]);
      if (floor.signed_distance_m(point.cast<double>()) >
          0.03 + static_cast<double>(all.tolerance_m[i])) {
        above.add(point, {all.normal_x[i], all.normal_y[i], all.normal_z[i]}, all.tolerance_m[i],
                  all.source[i]);
      }
    }
  }
  return above;
}

/// What a plane shows of itself.
struct Shown {
  double area_m2 = 0.0;
  double width_m = 0.0;
};

Shown shown_by(Plane const& wall, Eigen::Vector3d const& up, PlaneSearchPoints const& points,
               std::span<std::uint8_t const> inliers) {
  Eigen::Vector3d const along = up.cross(wall.normal).normalized();
  std::set<std::pair<long, long>> cells;
  long left = std::numeric_limits<long>::max();
  long right = std::numeric_limits<long>::min();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (inliers[i] == 0) {
      continue;
    }
    Eigen::Vector3d const p(points.x[i], points.y[i], points.z[i]);
    long const column = std::lround(along.dot(p) / kCell_m);
    cells.emplace(column, std::lround(up.dot(p) / kCell_m));
    left = std::min(left, column);
    right = std::max(right, column);
  }
  return cells.empty() ? Shown{}
                       : Shown{static_cast<double>(cells.size()) * kCell_m * kCell_m,
                               static_cast<double>(right - left) * kCell_m};
}

double share_behind(Plane const& wall, PlaneSearchPoints const& points, std::size_t own) {
  std::size_t behind = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Vector3d const p(points.x[i], points.y[i], points.z[i]);
    double const clear_m = 0.05 + 3.0 * static_cast<double>(points.tolerance_m[i]);
    behind += wall.signed_distance_m(p) < -clear_m ? 1U : 0U;
  }
  return static_cast<double>(behind) / static_cast<double>(std::max<std::size_t>(own, 1));
}

}  // namespace

std::optional<Plane> find_wall(std::span<PlaneSearchPoints const> frames,
                               Plane const& floor_camera) {
  PlaneSearchPoints const all = points_above(frames, floor_camera);
  PlaneSearchPoints remaining = all;
  PlaneSearchLimits const limits{
      PlaneSampling::kPointAndNormal, kMaxAngle_rad, 0.9999, 400, 2048, 1};
  std::optional<Plane> wall;
  double wall_area_m2 = 0.0;
  for (int k = 0; k < kMaxPlanes; ++k) {
    std::optional<FoundPlane> const found = find_largest_plane(remaining, limits);
    if (!found || found->inlier_count < 50) {
      break;
    }
    Plane const plane = found->plane.offset_m > 0.0 ? found->plane.flipped() : found->plane;
    if (std::abs(plane.normal.dot(floor_camera.normal)) < kMaxLean) {
      FoundPlane const whole = inliers_of(plane, all, kMaxAngle_rad);
      Shown const shown = shown_by(plane, floor_camera.normal, all, whole.inliers);
      if (shown.area_m2 >= std::max(kLeastArea_m2, wall_area_m2) &&
          shown.width_m >= kLeastWidth_m &&
          share_behind(plane, all, whole.inlier_count) <= kMaxShareBehind) {
        wall = plane;
        wall_area_m2 = shown.area_m2;
      }
    }
    remaining.remove(found->inliers);
  }
  return wall;
}

}  // namespace credo
