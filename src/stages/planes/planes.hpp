#pragma once

#include <cstdint>

#include "core/cloud.hpp"
#include "core/fields.hpp"
#include "core/frame.hpp"
#include "core/segmentation.hpp"
#include "geometry/plane_search.hpp"

namespace credo {

enum class WallBeyond : std::uint8_t { kEitherSide, kBehind };

/// Floor and walls (thesis 3.2 and algorithm 2). The thesis' numbers are marked T; it leaves the
/// sensor's noise and the points' normals out of account.
struct PlanesConfig {
  /// A point belongs to a plane within this distance (T: 0.05) ...
  double inlier_distance_m = 0.015;
  /// ... or within this many standard deviations of a Kinect's axial noise, if that is more
  /// (0.0012 + 0.0019 (z - 0.4)^2 m: Nguyen et al. 2012); 0 leaves noise out.
  double noise_sigmas = 4.0;
  /// A point with a normal belongs to a plane only within this angle; pi/2 or more switches it off.
  double max_angle_rad = 0.35;
  /// A plane with fewer inliers is none (T: 150), and without segments ends the search, as does
  /// the last of so many planes.
  int min_plane_pixels = 1500;
  int max_planes = 16;
  PlaneSampling sampling = PlaneSampling::kPointAndNormal;
  double confidence = 0.99;
  int max_hypotheses = 100;
  int scoring_points = 2048;
  int sample_points = 4096;
  int seed = 1;
  /// Floor: horizontal components of the normal at most this (T: 0.5), the vertical one at least
  /// one minus the other (T: 0.1), mean |z| of the inliers at most the third (T: 0.1).
  double floor_max_normal_xy = 0.5;
  double floor_max_normal_z_gap = 0.1;
  double floor_max_mean_height_m = 0.1;
  /// Pixels farther than this from z = 0 are not floor, whatever their plane; 0 for no limit. What
  /// the level and the camera's pose may be wrong by.
  double floor_max_height_m = 0.12;
  /// Wall: |n_z| below this (T: 0.1) ...
  double wall_max_normal_z = 0.1;
  /// ... |n_x| or |n_y| above this (T: 0.5) ...
  double wall_min_normal_xy = 0.5;
  /// ... with nothing beyond it: on one of its sides, whichever (T), or on that which faces away
  /// from the camera; before the front edge of a table, too, there may be nothing. What is seen
  /// there through a doorway, or round the corner where a wall ends, does not count ...
  WallBeyond wall_beyond = WallBeyond::kBehind;
  /// ... but at most so many points (T: 50), or so large a share of the plane's own
  /// pixels.
  int wall_max_points_beyond = 50;
  double wall_max_share_beyond = 0.03;
  /// Walls with fewer pixels, or lower from their foot to their top, stay in the cloud.
  int wall_min_pixels = 4000;
  double wall_min_extent_m = 0.4;
  /// Spacing of the points that are handed to the belief.
  double point_spacing_m = 0.05;
};
FieldList fields(PlanesConfig& config);

/// Labels floor and walls among the unassigned pixels and adds their observations; planes that are
/// neither keep their pixels unassigned. Walls are numbered from 2000 in the order they are found,
/// largest first. No pixels, no plane or no level (`floor_at_zero` false: no floor) is no error.
///
/// Where there are segments, floor and walls are made of them: one that a plane holds most of
/// belongs to it as far as it keeps near, and of one that it holds little of it takes nothing. So
/// the foot of what stands on the floor is not floor, and a carpet's rough edge is. Walls are
/// fitted to their largest segment and to those coplanar with it. Walls are looked for in
/// one segment after the other, the floor in what is low (segment_planes.hpp); without segments
/// both are in all that is left (thesis algorithm 2).
Segmentation extract_planes(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                            PlanesConfig const& config);

}  // namespace credo
