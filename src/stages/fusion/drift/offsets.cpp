#include "stages/fusion/drift/offsets.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "stages/fusion/points.hpp"

namespace credo {
namespace {

// Which wall an observation is of.
constexpr double kParallel = 0.15;
constexpr double kNear_m = 0.15;
constexpr double kBesideSegment_m = 0.25;
constexpr double kLeastBesideSegment = 0.3;

// Which things are held on to.
constexpr double kLittleDoubt = 0.9;
constexpr std::size_t kFewLooks = 3;

/// Of what is believed, and of a surface that is not quite flat.
constexpr double kBeliefSigma_m = 0.003;
/// A surface that is seen at a lower angle is not measured where its normal says.
constexpr double kLeastFacing = 0.25;
/// Where something so much nearer is beside a block, an edge is.
constexpr float kNearestOfDepth = 0.97F;

/// Standard deviation of a depth: it grows with the square, as that of disparity does not.
double depth_sigma_m(double depth_m) {
  return 0.001 + 0.002 * depth_m * depth_m;
}

/// Of a point's distance from a plane: noise moves the point along its ray.
double sigma_m(Eigen::Vector3d const& p_camera, Eigen::Vector3d const& normal_camera) {
  double const along_m = normal_camera.dot(p_camera) / p_camera.z() * depth_sigma_m(p_camera.z());
  return std::sqrt(kBeliefSigma_m * kBeliefSigma_m + along_m * along_m);
}

Eigen::Vector3d point_of(Sight const& sight, Pixel block) {
  CameraIntrinsics const& k = sight.intrinsics;
  Pixel const pixel = sight.middle_of(block);
  double const z_m = sight.depth_m[block];
  return {(pixel.u - k.cx_px) / k.fx_px * z_m, (pixel.v - k.cy_px) / k.fy_px * z_m, z_m};
}

/// Whether a wall of the belief is where an observation has one.
bool may_be(WallBelief const& wall, Plane const& seen, PointList const& points_world,
            Se3 const& T_expected_world) {
  Plane const& plane = wall.plane_world;
  if (!is_finite(plane) || !(plane.normal.cross(seen.normal).norm() < kParallel)) {
    return false;
  }
  Eigen::Vector2d const span = wall.segment_end_m - wall.segment_start_m;
  double const length_m = span.norm();
  if (!(length_m > 0.0)) {
    return false;
  }
  std::size_t beside = 0;
  for (Eigen::Vector3f const& point : points_world) {
    Eigen::Vector3d const p = T_expected_world * point.cast<double>();
    double const along_m = span.dot(p.head<2>() - wall.segment_start_m) / length_m;
    beside += along_m > -kBesideSegment_m && along_m < length_m + kBesideSegment_m ? 1U : 0U;
  }
  return static_cast<double>(beside) >=
         kLeastBesideSegment * static_cast<double>(points_world.size());
}

/// The believed plane of the wall that an observation is of; none where there is none.
std::optional<Plane> believed_plane(std::vector<WallBelief> const& walls,
                                    WallObservation const& seen, Se3 const& T_expected_world) {
  if (seen.points_world.empty() || !is_finite(seen.plane_world)) {
    return std::nullopt;
  }
  Plane const plane = transformed(T_expected_world, seen.plane_world);
  Eigen::Vector3d const middle = T_expected_world * centroid_of(seen.points_world);
  std::optional<Plane> nearest;
  double nearest_m = kNear_m;
  for (WallBelief const& wall : walls) {
    double const distance_m = std::abs(wall.plane_world.signed_distance_m(middle));
    if (distance_m < nearest_m && may_be(wall, plane, seen.points_world, T_expected_world)) {
      nearest = wall.plane_world;
      nearest_m = distance_m;
    }
  }
  return nearest;
}

/// The plane through the centroid of the floor's points.
std::optional<Plane> plane_of(std::optional<FloorBelief> const& floor) {
  if (!floor) {
    return std::nullopt;
  }
  Plane const plane{floor->normal, floor->normal.dot(centroid_of(*floor->points))};
  return is_finite(plane) ? std::optional(plane) : std::nullopt;
}

}  // namespace

DriftView::DriftView(BeliefState const& belief, Segmentation const& segmentation,
                     Se3 const& T_world_camera_expected)
    : sight_(segmentation.sight) {
  gather_planes(belief, segmentation, T_world_camera_expected);
  gather_items(belief);
}

void DriftView::gather_planes(BeliefState const& belief, Segmentation const& segmentation,
                              Se3 const& T_world_camera_expected) {
  Se3 const T_expected_world = T_world_camera_expected * segmentation.T_world_camera.inverse();
  // By label: the floor's place, then the walls'.
  std::vector<std::ptrdiff_t> place(1 + segmentation.walls.size(), -1);
  auto const add = [&](SurfaceKind kind, std::optional<Plane> const& plane, std::size_t label) {
    if (plane && label < place.size()) {
      place[label] = static_cast<std::ptrdiff_t>(planes_.size());
      planes_.push_back({kind, *plane, {}});
    }
  };
  add(SurfaceKind::kGround, plane_of(belief.floor), 0);
  for (WallObservation const& wall : segmentation.walls) {
    add(SurfaceKind::kWall, believed_plane(belief.walls, wall, T_expected_world),
        wall.label - std::size_t{kFirstWall} + 1);
  }
  for (int v = kBlockStride / 2; v < sight_.labels.height(); v += kBlockStride) {
    for (int u = kBlockStride / 2; u < sight_.labels.width(); u += kBlockStride) {
      LabelCode const label = sight_.labels[{u, v}];
      if ((label != kFloor && !is_wall(label)) || !(sight_.depth_m[{u, v}] > 0.0F)) {
        continue;
      }
      std::size_t const of = label == kFloor ? 0 : label - std::size_t{kFirstWall} + 1;
      if (of < place.size() && place[of] >= 0) {
        planes_[static_cast<std::size_t>(place[of])].points_camera.push_back(
            point_of(sight_, {u, v}));
      }
    }
  }
}

void DriftView::gather_items(BeliefState const& belief) {
  if (sight_.normals_camera.empty()) {
    return;
  }
  for (StuffBelief const& item : belief.stuff) {
    if (item.model == nullptr || item.history_count < kFewLooks ||
        !(probability_of(item.log_odds) > kLittleDoubt)) {
      continue;
    }
    std::vector<SurfacePoint> const& points = item.model->points;
    std::size_t const stride = (points.size() + kPointsOfItem - 1) / kPointsOfItem;
    std::vector<Eigen::Vector3d>& some = items_.emplace_back();
    for (std::size_t i = 0; i < points.size(); i += stride) {
      some.push_back(points[i].p_world.cast<double>());
    }
  }
}

SurfaceOffsets DriftView::plane_offsets(PlaneBlocks const& blocks, Se3 const& T_world_camera,
                                        double most_sigmas) const {
  SurfaceOffsets surface{.kind = blocks.kind, .offsets = {}};
  Eigen::Matrix3d const R = T_world_camera.rotation().toRotationMatrix();
  Eigen::Vector3d const normal_camera = R.transpose() * blocks.plane_world.normal;
  surface.offsets.reserve(blocks.points_camera.size());
  for (Eigen::Vector3d const& p_camera : blocks.points_camera) {
    Eigen::Vector3d const p_world = R * p_camera + T_world_camera.translation();
    double const distance_m = blocks.plane_world.signed_distance_m(p_world);
    double const sigma = sigma_m(p_camera, normal_camera);
    if (std::abs(distance_m) <= most_sigmas * sigma) {
      surface.offsets.push_back({p_world, blocks.plane_world.normal, distance_m, sigma});
    }
  }
  return surface;
}

SurfaceOffsets DriftView::item_offsets(std::vector<Eigen::Vector3d> const& points_world,
                                       Se3 const& T_world_camera, double most_sigmas) const {
  SurfaceOffsets surface{.kind = SurfaceKind::kThing, .offsets = {}};
  surface.offsets.reserve(points_world.size());
  Eigen::Matrix3d const R = T_world_camera.rotation().toRotationMatrix();
  CameraIntrinsics const& k = sight_.intrinsics;
  for (Eigen::Vector3d const& point_world : points_world) {
    Eigen::Vector3d const p = R.transpose() * (point_world - T_world_camera.translation());
    // In blocks.
    double const u = (k.fx_px * p.x() / p.z() + k.cx_px + 0.5) / sight_.block_px;
    double const v = (k.fy_px * p.y() / p.z() + k.cy_px + 0.5) / sight_.block_px;
    if (!(p.z() > 0.0 && u >= 0.0 && v >= 0.0 && u < sight_.depth_m.width() &&
          v < sight_.depth_m.height())) {
      continue;
    }
    Pixel const block{static_cast<int>(u), static_cast<int>(v)};
    // At an edge it may be another thing, which is nearer and hides this one.
    if (!is_stuff(sight_.labels[block]) || !(sight_.depth_m[block] > 0.0F) ||
        sight_.nearest_m[block] < kNearestOfDepth * sight_.depth_m[block]) {
      continue;
    }
    Eigen::Vector3d const normal = sight_.normals_camera.at(block).cast<double>();
    Eigen::Vector3d const seen = point_of(sight_, block);
    if (!(-normal.dot(seen) > kLeastFacing * seen.norm())) {
      continue;
    }
    double const distance_m = normal.dot(seen - p);
    double const sigma = sigma_m(seen, normal);
    if (std::abs(distance_m) <= most_sigmas * sigma) {
      surface.offsets.push_back(
          {R * seen + T_world_camera.translation(), R * normal, distance_m, sigma});
    }
  }
  return surface;
}

std::vector<SurfaceOffsets> DriftView::offsets(Se3 const& T_world_camera,
                                               double most_sigmas) const {
  std::vector<SurfaceOffsets> surfaces;
  auto const add = [&](SurfaceOffsets surface) {
    if (!surface.offsets.empty()) {
      surfaces.push_back(std::move(surface));
    }
  };
  for (PlaneBlocks const& blocks : planes_) {
    add(plane_offsets(blocks, T_world_camera, most_sigmas));
  }
  for (std::vector<Eigen::Vector3d> const& points_world : items_) {
    add(item_offsets(points_world, T_world_camera, most_sigmas));
  }
  return surfaces;
}

}  // namespace credo
