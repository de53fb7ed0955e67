#include <iterator>

#include "stages/planes/planes.hpp"

namespace credo {
namespace {

FieldList search_fields(PlanesConfig& config) {
  return {
      {"inlier_distance_m",
       &config.inlier_distance_m,
       {1e-4, 1},
       "m",
       "a point belongs to a plane within this distance"},
      {"noise_sigmas",
       &config.noise_sigmas,
       {0, 20},
       "",
       "... or within this many sigmas of a Kinect's axial noise, if that is more; 0 leaves it "
       "out"},
      {"max_angle_rad",
       &config.max_angle_rad,
       {0, 3.15},
       "rad",
       "greatest angle between a point's normal and its plane's; from pi/2 on not tested"},
      {"min_plane_pixels",
       &config.min_plane_pixels,
       {3, 1e6},
       "pixels",
       "a plane with fewer inliers is none; without segments it ends the search"},
      {"max_planes",
       &config.max_planes,
       {1, 10000},
       "",
       "planes to look for in a frame, at most; of no account where there are segments"},
      choice("sampling", config.sampling, {"three_points", "point_and_normal"},
             "what RANSAC draws a plane from"),
      {"confidence",
       &config.confidence,
       {0.5, 0.999999},
       "",
       "draws stop once a better plane would have been found with this probability"},
      {"max_hypotheses", &config.max_hypotheses, {1, 100000}, "", "draws for a plane, at most"},
      {"scoring_points",
       &config.scoring_points,
       {16, 1e7},
       "points",
       "draws are compared on so many evenly spread points; the inliers of the best are exact"},
      {"sample_points",
       &config.sample_points,
       {1024, 1e7},
       "points",
       "a plane is drawn from and fitted to so many evenly spread points at most"},
      {"seed", &config.seed, {0, 2e9}, "", "seed of the draws"},
  };
}

FieldList kind_fields(PlanesConfig& config) {
  return {
      {"floor_max_normal_xy",
       &config.floor_max_normal_xy,
       {0, 1},
       "",
       "floor: greatest |n_x| and |n_y|"},
      {"floor_max_normal_z_gap",
       &config.floor_max_normal_z_gap,
       {0, 1},
       "",
       "floor: greatest 1 - n_z"},
      {"floor_max_mean_height_m",
       &config.floor_max_mean_height_m,
       {0, 10},
       "m",
       "floor: greatest mean |z| of the inliers"},
      {"floor_max_height_m",
       &config.floor_max_height_m,
       {0, 10},
       "m",
       "floor: greatest |z| of a pixel; 0 for no limit"},
      {"wall_max_normal_z", &config.wall_max_normal_z, {0, 1}, "", "wall: |n_z| below this"},
      {"wall_min_normal_xy",
       &config.wall_min_normal_xy,
       {0, 1},
       "",
       "wall: |n_x| or |n_y| above this"},
      choice("wall_beyond", config.wall_beyond, {"either_side", "behind"},
             "wall: where nothing may be: on one of its sides, whichever, or behind it"),
      {"wall_max_points_beyond",
       &config.wall_max_points_beyond,
       {0, 1e7},
       "points",
       "wall: points of the whole cloud that may lie clear of it there"},
      {"wall_max_share_beyond",
       &config.wall_max_share_beyond,
       {0, 1},
       "",
       "... or so many for each of its own pixels, if that is more"},
      {"wall_min_pixels", &config.wall_min_pixels, {0, 1e7}, "pixels", "wall: pixels, at least"},
      {"wall_min_extent_m",
       &config.wall_min_extent_m,
       {0, 10},
       "m",
       "wall: height from its lowest to its highest point, at least"},
      {"point_spacing_m",
       &config.point_spacing_m,
       {0.001, 1},
       "m",
       "spacing of the floor's and the walls' points in the belief"},
  };
}

}  // namespace

FieldList fields(PlanesConfig& config) {
  FieldList all = search_fields(config);
  FieldList kinds = kind_fields(config);
  all.insert(all.end(), std::make_move_iterator(kinds.begin()),
             std::make_move_iterator(kinds.end()));
  return all;
}

}  // namespace credo
