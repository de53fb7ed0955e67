#include "stages/planes/is_wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace credo {
namespace {

/// Height from the lowest to the highest pixel, without the outermost per cent at either end.
double vertical_extent_m(PlaneView const& view, PixelPlane const& plane) {
  Heights const height_m(view);
  std::vector<float> heights;
  heights.reserve(plane.inliers.count);
  plane.inliers.pixels.for_each([&](std::size_t i) { heights.push_back(height_m(i)); });
  auto const cut = static_cast<std::ptrdiff_t>(heights.size() / 100);
  auto const top = static_cast<std::ptrdiff_t>(heights.size()) - 1 - cut;
  std::nth_element(heights.begin(), heights.begin() + cut, heights.end());
  float const low_m = heights[static_cast<std::size_t>(cut)];
  std::nth_element(heights.begin(), heights.begin() + top, heights.end());
  return static_cast<double>(heights[static_cast<std::size_t>(top)] - low_m);
}

}  // namespace

bool is_wall(PlaneView const& view, PixelPlane const& plane) {
  PlanesConfig const& config = view.config;
  Eigen::Vector3d const n = plane.world.normal.cwiseAbs();
  if (!(n.z() < config.wall_max_normal_z) ||
      !(std::max(n.x(), n.y()) > config.wall_min_normal_xy) ||
      plane.inliers.count < static_cast<std::size_t>(config.wall_min_pixels)) {
    return false;
  }
  SideCounts const sides = count_sides(plane.camera, view.cloud, view.valid.pixels, view.tolerance);
  double const allowed =
      std::max(static_cast<double>(config.wall_max_points_beyond),
               config.wall_max_share_beyond * static_cast<double>(plane.inliers.count));
  // The camera is at the origin.
  bool const faces_camera = plane.camera.signed_distance_m(Eigen::Vector3d::Zero()) >= 0.0;
  std::size_t const behind = faces_camera ? sides.back : sides.front;
  std::size_t const beyond =
      config.wall_beyond == WallBeyond::kBehind ? behind : std::min(sides.front, sides.back);
  return static_cast<double>(beyond) <= allowed &&
         vertical_extent_m(view, plane) >= config.wall_min_extent_m;
}

}  // namespace credo
