#include "stages/fusion/stuff/known_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/pose_fusion.hpp"
#include "stages/fusion/points.hpp"

namespace credo {
namespace {

/// How far beyond its ends a wall may go on.
constexpr double kBeyondEnd_m = 0.1;

/// An object whose place is not known as well as that explains nothing.
constexpr double kKnown_m = 0.02;

/// What lies there by so much is the object, if that stands there.
constexpr double kMostOfIt = 0.7;

}  // namespace

KnownPlaces::KnownPlaces(BeliefState const& belief, KnownSurfaces const& surfaces)
    : camera_world_(belief.T_world_camera.translation()) {
  if (belief.last_sight != nullptr) {
    before_.emplace(belief.last_sight->sight, belief.last_sight->T_world_camera);
    for (LabelCode const label : belief.last_sight->sight.labels) {
      if (is_object(label)) {
        shown_before_.insert(label);
      }
    }
  }
  if (belief.floor && belief.floor->log_odds > 0.0) {
    Eigen::Vector3d middle = centroid_of(*belief.floor->points);
    middle.z() = belief.floor->height_m;
    floor_world_ = Plane{belief.floor->normal, belief.floor->normal.dot(middle)};
  }
  for (WallBelief const& wall : belief.walls) {
    Eigen::Vector2d const along = wall.segment_end_m - wall.segment_start_m;
    if (wall.log_odds > 0.0 && along.norm() > 0.0) {
      walls_.push_back({wall.plane_world, wall.segment_start_m, along.normalized(), along.norm()});
    }
  }
  for (ObjectBelief const& object : belief.objects) {
    auto const surface = surfaces.find(object.type);
    if (surface == surfaces.end()) {
      continue;
    }
    if (object.log_odds > 0.0) {
      add_known(object.label ? shown_ : objects_, surface->second, object.pose_world,
                object.log_odds);
    }
    if (object.other_place) {
      add_known(other_places_, surface->second, object.other_place->pose_world,
                object.other_place->log_odds);
    }
  }
}

void KnownPlaces::add_known(std::vector<Place>& places, KnownSurface const& surface,
                            PoseDistribution const& pose_world, double log_odds) {
  double const sigma_m = largest_deviation_m(pose_world, surface.radius_m, surface.symmetry);
  if (sigma_m <= kKnown_m) {
    places.push_back(
        {surface.shape.get(), pose_world.mean.inverse(), sigma_m, surface.radius_m, log_odds});
  }
}

double KnownPlaces::noise_m(Eigen::Vector3d const& p_world) const {
  return surface_tolerance_m((p_world - camera_world_).squaredNorm());
}

double KnownPlaces::share_known(std::span<Eigen::Vector3f const> points_world,
                                bool may_be_object) const {
  auto const known = std::ranges::count_if(points_world, [&](Eigen::Vector3f const& point) {
    Eigen::Vector3d const p_world = point.cast<double>();
    return has_floor_at(p_world) || has_wall_at(p_world) ||
           (may_be_object && has_object_at(p_world));
  });
  return points_world.empty()
             ? 0.0
             : static_cast<double>(known) / static_cast<double>(points_world.size());
}

bool KnownPlaces::are_on_walls(std::span<Eigen::Vector3f const> points_world, double share) const {
  std::size_t there = 0;
  double before_m = 0.0;
  for (Eigen::Vector3f const& point : points_world) {
    Eigen::Vector3d const p_world = point.cast<double>();
    if (Strip const* const wall = wall_at(p_world)) {
      Plane const& plane = wall->plane_world;
      ++there;
      before_m += std::copysign(1.0, plane.signed_distance_m(camera_world_)) *
                      plane.signed_distance_m(p_world) -
                  mean_tolerance_m((p_world - camera_world_).squaredNorm());
    }
  }
  return static_cast<double>(there) > share * static_cast<double>(points_world.size()) &&
         before_m <= 0.0;
}

double KnownPlaces::share_left_behind(std::span<Eigen::Vector3f const> points_world) const {
  if (shown_.empty() || points_world.empty()) {
    return 0.0;
  }
  auto const left = std::ranges::count_if(points_world, [&](Eigen::Vector3f const& point) {
    Eigen::Vector3d const p_world = point.cast<double>();
    return std::ranges::any_of(shown_,
                               [&](Place const& place) { return is_left_behind(place, p_world); });
  });
  return static_cast<double>(left) / static_cast<double>(points_world.size());
}

double KnownPlaces::share_free_before(std::span<Eigen::Vector3f const> points_world) const {
  constexpr int kLeastPoints = 8;
  if (!before_) {
    return 0.0;
  }
  PointCounts counts;
  for (Eigen::Vector3f const& p_world : points_world) {
    ++counts[before_->look_at(p_world)];
  }
  int const free = counts[PointState::kSeenThrough];
  int const told = free + counts[PointState::kAgrees];
  return told < kLeastPoints ? 0.0 : static_cast<double>(free) / told;
}

KnownPlaces::Strip const* KnownPlaces::wall_at(Eigen::Vector3d const& p_world) const {
  double nearest_m = noise_m(p_world);
  Strip const* nearest = nullptr;
  for (Strip const& wall : walls_) {
    double const along_m = wall.direction.dot(p_world.head<2>() - wall.start_m);
    double const distance_m = std::abs(wall.plane_world.signed_distance_m(p_world));
    if (distance_m < nearest_m && along_m > -kBeyondEnd_m &&
        along_m < wall.length_m + kBeyondEnd_m) {
      nearest_m = distance_m;
      nearest = &wall;
    }
  }
  return nearest;
}

bool KnownPlaces::has_wall_at(Eigen::Vector3d const& p_world) const {
  return wall_at(p_world) != nullptr;
}

bool KnownPlaces::has_floor_at(Eigen::Vector3d const& p_world) const {
  constexpr double kThinnest_m = 0.005;
  double const above_m = floor_world_ ? floor_world_->signed_distance_m(p_world) : kThinnest_m;
  return above_m < kThinnest_m && above_m > -noise_m(p_world);
}

bool KnownPlaces::has_object_at(Eigen::Vector3d const& p_world) const {
  return std::ranges::any_of(objects_, [&](Place const& place) { return is_at(place, p_world); });
}

bool KnownPlaces::is_at(Place const& place, Eigen::Vector3d const& p_world) const {
  double const tolerance_m = noise_m(p_world) + 2.0 * place.deviation_m;
  Eigen::Vector3d const p_object = place.T_object_world * p_world;
  return p_object.norm() < place.radius_m + tolerance_m &&
         std::abs(place.shape->distance_to(p_object).distance_m) < tolerance_m;
}

bool KnownPlaces::is_left_behind(Place const& place, Eigen::Vector3d const& p_world) {
  // Steeper than 45 degrees.
  constexpr double kFacesUp = 0.7;
  Eigen::Vector3d const p_object = place.T_object_world * p_world;
  double const most_m = 2.0 * place.deviation_m;
  if (p_object.norm() > place.radius_m + most_m) {
    return false;
  }
  SurfaceDistance const nearest = place.shape->distance_to(p_object);
  Eigen::Vector3d const facing = place.T_object_world.rotation().conjugate() * nearest.normal;
  return std::abs(nearest.distance_m) < most_m && facing.z() < kFacesUp;
}

double KnownPlaces::most_log_odds_at(std::span<Eigen::Vector3f const> points_world) const {
  double most = std::numeric_limits<double>::infinity();
  for (Place const& place : other_places_) {
    auto const there = std::ranges::count_if(points_world, [&](Eigen::Vector3f const& p_world) {
      return is_at(place, p_world.cast<double>());
    });
    if (static_cast<double>(there) > kMostOfIt * static_cast<double>(points_world.size())) {
      most = std::min(most, -place.log_odds);
    }
  }
  return most;
}

}  // namespace credo
