#include "stages/planes/planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/thinning.hpp"

namespace credo {
namespace {

/// Axial noise of a Kinect at depth z, one standard deviation (Nguyen, Izadi and Lovell 2012).
float axial_noise_m(float depth_m) {
  float const beyond = depth_m - 0.4F;
  return 0.0012F + 0.0019F * beyond * beyond;
}

/// The frame's valid points in the world frame, with the distance at which each counts as an
/// inlier. `source` is the pixel.
PlaneSearchPoints world_points(Frame const& frame, NormalMap const& normals,
                               Se3 const& T_world_camera, PlanesConfig const& config) {
  OrganizedCloud const& cloud = frame.cloud_camera;
  Eigen::Matrix3f const R = T_world_camera.rotation().toRotationMatrix().cast<float>();
  Eigen::Vector3f const t = T_world_camera.translation().cast<float>();
  auto const fixed_m = static_cast<float>(config.inlier_distance_m);
  auto const sigmas = static_cast<float>(config.noise_sigmas);
  PlaneSearchPoints points;
  points.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.valid(i)) {
      float const tolerance_m = std::max(fixed_m, sigmas * axial_noise_m(cloud.z[i]));
      points.add(R * cloud.at(i) + t, R * normals.at(i), tolerance_m,
                 static_cast<std::uint32_t>(i));
    }
  }
  return points;
}

/// Thesis 3.2: horizontal, and at z = 0. The plane's normal points up.
bool is_floor(FoundPlane const& found, PlaneSearchPoints const& points,
              PlanesConfig const& config) {
  Eigen::Vector3d const& n = found.plane.normal;
  if (std::abs(n.x()) > config.floor_max_normal_xy ||
      std::abs(n.y()) > config.floor_max_normal_xy ||
      std::abs(n.z() - 1.0) > config.floor_max_normal_z_gap) {
    return false;
  }
  double sum_m = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum_m += found.inliers[i] != 0 ? std::abs(static_cast<double>(points.z[i])) : 0.0;
  }
  return sum_m <= config.floor_max_mean_height_m * static_cast<double>(found.inlier_count);
}

/// Points of the whole cloud clear of the plane on that of its sides where fewer are.
std::size_t points_beyond(Plane const& plane, PlaneSearchPoints const& all) {
  Eigen::Vector3f const n = plane.normal.cast<float>();
  auto const offset_m = static_cast<float>(plane.offset_m);
  std::uint32_t front = 0;
  std::uint32_t back = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    float const distance = n.x() * all.x[i] + n.y() * all.y[i] + n.z() * all.z[i] - offset_m;
    front += static_cast<std::uint32_t>(distance > all.tolerance_m[i]);
    back += static_cast<std::uint32_t>(distance < -all.tolerance_m[i]);
  }
  return std::min(front, back);
}

/// Height from the lowest to the highest inlier, without the outermost per cent at either end.
double vertical_extent_m(FoundPlane const& found, PlaneSearchPoints const& points) {
  std::vector<float> heights;
  heights.reserve(found.inlier_count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (found.inliers[i] != 0) {
      heights.push_back(points.z[i]);
    }
  }
  if (heights.empty()) {
    return 0.0;
  }
  auto const cut = static_cast<std::ptrdiff_t>(heights.size() / 100);
  std::nth_element(heights.begin(), heights.begin() + cut, heights.end());
  float const low = heights[static_cast<std::size_t>(cut)];
  auto const top = static_cast<std::ptrdiff_t>(heights.size()) - 1 - cut;
  std::nth_element(heights.begin(), heights.begin() + top, heights.end());
  return static_cast<double>(heights[static_cast<std::size_t>(top)] - low);
}

/// Thesis 3.2: vertical, with nearly nothing beyond it.
bool is_wall(FoundPlane const& found, PlaneSearchPoints const& points, PlaneSearchPoints const& all,
             PlanesConfig const& config) {
  Eigen::Vector3d const n = found.plane.normal.cwiseAbs();
  if (!(n.z() < config.wall_max_normal_z) ||
      !(std::max(n.x(), n.y()) > config.wall_min_normal_xy) ||
      found.inlier_count < static_cast<std::size_t>(config.wall_min_pixels)) {
    return false;
  }
  double const allowed =
      std::max(static_cast<double>(config.wall_max_points_beyond),
               config.wall_max_share_beyond * static_cast<double>(found.inlier_count));
  return static_cast<double>(points_beyond(found.plane, all)) <= allowed &&
         vertical_extent_m(found, points) >= config.wall_min_extent_m;
}

/// Writes the label on the plane's pixels and returns their world points, thinned.
PointList label_inliers(FoundPlane const& found, PlaneSearchPoints const& points, LabelCode code,
                        double spacing_m, LabelMap& labels) {
  PointList inliers;
  inliers.reserve(found.inlier_count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (found.inliers[i] != 0) {
      labels[points.source[i]] = code;
      inliers.emplace_back(points.x[i], points.y[i], points.z[i]);
    }
  }
  return thin_points(inliers, static_cast<float>(spacing_m));
}

void add_floor(FoundPlane const& found, PlaneSearchPoints const& points, PlanesConfig const& config,
               Segmentation& segmentation) {
  PointList added =
      label_inliers(found, points, kFloor, config.point_spacing_m, segmentation.labels);
  if (!segmentation.floor) {
    segmentation.floor = FloorObservation{found.plane, std::move(added), found.inlier_count};
    return;
  }
  // A later plane that passes too is more of the same floor; the largest one's fit stays.
  FloorObservation& floor = *segmentation.floor;
  floor.points_world.insert(floor.points_world.end(), added.begin(), added.end());
  floor.points_world = thin_points(floor.points_world, static_cast<float>(config.point_spacing_m));
  floor.pixel_count += found.inlier_count;
}

void add_wall(FoundPlane const& found, PlaneSearchPoints const& points, PlanesConfig const& config,
              Segmentation& segmentation) {
  WallObservation wall;
  wall.label = static_cast<LabelCode>(kFirstWall + segmentation.walls.size());
  wall.plane_world = found.plane;
  if (wall.plane_world.signed_distance_m(segmentation.T_world_camera.translation()) < 0) {
    wall.plane_world = wall.plane_world.flipped();
  }
  wall.points_world =
      label_inliers(found, points, wall.label, config.point_spacing_m, segmentation.labels);
  wall.pixel_count = found.inlier_count;
  segmentation.walls.push_back(std::move(wall));
}

/// What is left to search: the points of unassigned pixels.
PlaneSearchPoints unassigned_points(PlaneSearchPoints const& all, LabelMap const& labels) {
  PlaneSearchPoints remaining = all;
  std::vector<std::uint8_t> taken(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    taken[i] = static_cast<std::uint8_t>(labels[all.source[i]] != kUnassigned);
  }
  remaining.remove(taken);
  return remaining;
}

}  // namespace

Segmentation extract_planes(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                            PlanesConfig const& config) {
  PlaneSearchPoints const all = world_points(frame, normals, segmentation.T_world_camera, config);
  PlaneSearchPoints remaining = unassigned_points(all, segmentation.labels);
  PlaneSearchLimits limits{config.sampling,       config.max_angle_rad,  config.confidence,
                           config.max_hypotheses, config.scoring_points, 0};
  for (int k = 0; k < config.max_planes; ++k) {
    limits.seed = static_cast<std::uint32_t>(config.seed) + static_cast<std::uint32_t>(k);
    std::optional<FoundPlane> found = find_largest_plane(remaining, limits);
    if (!found || found->inlier_count < static_cast<std::size_t>(config.min_plane_pixels)) {
      break;
    }
    if (found->plane.normal.z() < 0) {
      found->plane = found->plane.flipped();
    }
    if (segmentation.floor_at_zero && is_floor(*found, remaining, config)) {
      add_floor(*found, remaining, config, segmentation);
    } else if (segmentation.walls.size() < kMaxWalls && is_wall(*found, remaining, all, config)) {
      add_wall(*found, remaining, config, segmentation);
    }
    remaining.remove(found->inliers);
  }
  return segmentation;
}

}  // namespace credo
