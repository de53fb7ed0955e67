#include "stages/fusion/stuff/shown_planes.hpp"

#include <cmath>
#include <cstddef>

#include "stages/fusion/points.hpp"

namespace credo {

ShownPlanes::ShownPlanes(Segmentation const& segmentation) : segmentation_(segmentation) {
  if (segmentation.floor) {
    plane_world_[kFloor] = segmentation.floor->plane_world;
  }
  for (WallObservation const& wall : segmentation.walls) {
    plane_world_[wall.label] = wall.plane_world;
  }
}

std::optional<ShownPlanes::Offset> ShownPlanes::offset_of(std::size_t block) const {
  Sight const& sight = segmentation_.sight;
  auto const plane = plane_world_.find(sight.labels[block]);
  if (plane == plane_world_.end()) {
    return std::nullopt;
  }
  Pixel const pixel = sight.middle_of(sight.labels.pixel(block));
  CameraIntrinsics const& k = sight.intrinsics;
  Eigen::Vector3d const ray((pixel.u - k.cx_px) / k.fx_px, (pixel.v - k.cy_px) / k.fy_px, 1.0);
  Eigen::Vector3d const p_camera = static_cast<double>(sight.depth_m[block]) * ray;
  Se3 const& T_world_camera = segmentation_.T_world_camera;
  double const off_m = plane->second.signed_distance_m(T_world_camera * p_camera);
  double const camera_m = plane->second.signed_distance_m(T_world_camera.translation());
  return Offset{std::copysign(1.0, camera_m) * off_m, p_camera.squaredNorm()};
}

bool ShownPlanes::are_what_shows(StuffLook const& look) const {
  int known = 0;
  int off = 0;
  int with_plane = 0;
  double before_m = 0.0;
  for (PointLook const& point : look.points) {
    auto const block = static_cast<std::size_t>(point.block);
    if (point.state != PointState::kAgrees || segmentation_.sight.labels[block] < kFloor ||
        is_stuff(segmentation_.sight.labels[block])) {
      continue;
    }
    ++known;
    if (std::optional<Offset> const offset = offset_of(block)) {
      ++with_plane;
      off += std::abs(offset->before_m) > surface_tolerance_m(offset->squared_distance_m2) ? 1 : 0;
      before_m += offset->before_m - mean_tolerance_m(offset->squared_distance_m2);
    }
  }
  bool const stands_before = 2 * with_plane > known && before_m > 0.0;
  return 2 * off <= known && !stands_before;
}

}  // namespace credo
