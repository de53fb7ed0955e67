#include "stages/planes/is_floor.hpp"

#include <cmath>
#include <cstddef>

namespace credo {

bool is_floor(PlaneView const& view, PixelPlane const& plane) {
  PlanesConfig const& config = view.config;
  Eigen::Vector3d const& n = plane.world.normal;
  if (!view.floor_at_zero || std::abs(n.x()) > config.floor_max_normal_xy ||
      std::abs(n.y()) > config.floor_max_normal_xy ||
      std::abs(n.z() - 1.0) > config.floor_max_normal_z_gap) {
    return false;
  }
  Heights const height_m(view);
  double sum_m = 0.0;
  plane.inliers.pixels.for_each(
      [&](std::size_t i) { sum_m += static_cast<double>(std::abs(height_m(i))); });
  return sum_m <= config.floor_max_mean_height_m * static_cast<double>(plane.inliers.count);
}

CountedPixels low_pixels(PlaneView const& view, CountedPixels pixels) {
  if (view.config.floor_max_height_m == 0.0) {
    return pixels;
  }
  auto const most_m = static_cast<float>(view.config.floor_max_height_m);
  Heights const height_m(view);
  CountedPixels high{PixelSet(view.cloud.size()), 0};
  pixels.pixels.for_each([&](std::size_t i) {
    if (std::abs(height_m(i)) > most_m) {
      high.insert(i);
    }
  });
  pixels.remove(high);
  return pixels;
}

}  // namespace credo
