#pragma once

#include <Eigen/Core>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/belief.hpp"
#include "core/label.hpp"
#include "geometry/shapes/known_surface.hpp"
#include "stages/fusion/sight_view.hpp"

namespace credo {

/// What was known of places before the frame. Where the believed floor, walls and known objects
/// are: what a frame shows there is nothing new, though no plane was laid through it and no
/// detector found it, as of a table that reaches into view by a corner.
///
/// Objects count that have no region in the last frame: where one has, all of it has been taken out
/// of the frame already, and what is left beside it may lie on it. And those whose place is known
/// to 2 cm.
class KnownPlaces {
public:
  /// `belief` as it is after the frame but for stuff and the last sight; both must outlive it.
  KnownPlaces(BeliefState const& belief, KnownSurfaces const& surfaces);

  /// Whether a wall is within 1.5 cm + 1.5 mm/m^2 times the squared distance from the camera (a
  /// Kinect's noise), no more than 10 cm beyond its ends.
  [[nodiscard]] bool has_wall_at(Eigen::Vector3d const& p_world) const;
  /// Whether the floor is as near above it, or no more than 5 mm below: what is thin lies on it.
  [[nodiscard]] bool has_floor_at(Eigen::Vector3d const& p_world) const;
  /// Whether an object's surface is as near, and two deviations of its place more.
  [[nodiscard]] bool has_object_at(Eigen::Vector3d const& p_world) const;

  /// How far a thing at these points may be believed: where for the most part a known object is
  /// found that is believed elsewhere (OtherPlace), either that stands there or a thing of its own.
  /// Infinite where none is.
  [[nodiscard]] double most_log_odds_at(std::span<Eigen::Vector3f const> points_world) const;

  /// The part of the points that are at known places. Not `may_be_object`: of floor and walls
  /// alone, for what lies on something: on a table it is none of that, however flat, but beside a
  /// cabinet a wall seems to lie on it.
  [[nodiscard]] double share_known(std::span<Eigen::Vector3f const> points_world,
                                   bool may_be_object) const;
  /// Whether so much of the points and more is on walls, and does not stand before them on the
  /// mean: by more than 1.5 cm + 0.5 mm/m^2 times the squared distance.
  [[nodiscard]] bool are_on_walls(std::span<Eigen::Vector3f const> points_world,
                                  double share) const;
  /// The part of the points that a pose which is not quite right has left behind: two deviations of
  /// an object's place, at most, from where it is believed to have a surface on which nothing can
  /// lie, as it does not face up. Of objects that the frame shows.
  [[nodiscard]] double share_left_behind(std::span<Eigen::Vector3f const> points_world) const;
  /// Of the points that the last frame told of, the part that it saw through: what stands there now
  /// came there since. 0 where it told of fewer than 8.
  [[nodiscard]] double share_free_before(std::span<Eigen::Vector3f const> points_world) const;
  /// Whether the last frame showed the known object that has this label in label images.
  [[nodiscard]] bool has_shown(LabelCode object) const { return shown_before_.contains(object); }

private:
  struct Strip {
    Plane plane_world;
    Eigen::Vector2d start_m;
    Eigen::Vector2d direction;
    double length_m = 0.0;
  };
  struct Place {
    ObjectShape const* shape = nullptr;
    Se3 T_object_world;
    double deviation_m = 0.0;
    double radius_m = 0.0;
    double log_odds = 0.0;
  };

  /// The wall that has_wall_at means, the nearest of several; null where there is none.
  [[nodiscard]] Strip const* wall_at(Eigen::Vector3d const& p_world) const;
  static void add_known(std::vector<Place>& places, KnownSurface const& surface,
                        PoseDistribution const& pose_world, double log_odds);
  [[nodiscard]] bool is_at(Place const& place, Eigen::Vector3d const& p_world) const;
  [[nodiscard]] static bool is_left_behind(Place const& place, Eigen::Vector3d const& p_world);
  [[nodiscard]] double noise_m(Eigen::Vector3d const& p_world) const;

  Eigen::Vector3d camera_world_;
  std::optional<SightView> before_;
  std::set<LabelCode> shown_before_;
  std::optional<Plane> floor_world_;
  std::vector<Strip> walls_;
  std::vector<Place> objects_;
  std::vector<Place> other_places_;
  /// Those that have a region in the frame.
  std::vector<Place> shown_;
};

}  // namespace credo
