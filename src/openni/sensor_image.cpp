#include "openni/sensor_image.hpp"

#include <algorithm>
#include <cmath>

#include "io/intrinsics.hpp"

namespace credo {
namespace {

constexpr double kFocalLength_px = 525.0;
constexpr double kWidth_px = 640.0;
constexpr double kMetresPerCount = 0.001;

double focal_length_px(int size_px, double fov_rad) {
  return 0.5 * size_px / std::tan(0.5 * fov_rad);
}

}  // namespace

CameraIntrinsics intrinsics_of(DepthOptics const& optics, CaptureConfig const& config) {
  if (auto const given = given_intrinsics(config, optics.width_px, optics.height_px)) {
    return *given;
  }
  auto const is_angle = [](std::optional<double> fov_rad) {
    return fov_rad && *fov_rad > 0.1 && *fov_rad < 3.0;
  };
  double const nominal_px = kFocalLength_px * optics.width_px / kWidth_px;
  bool const by_fov = is_angle(optics.horizontal_fov_rad) && is_angle(optics.vertical_fov_rad);
  return {by_fov ? focal_length_px(optics.width_px, *optics.horizontal_fov_rad) : nominal_px,
          by_fov ? focal_length_px(optics.height_px, *optics.vertical_fov_rad) : nominal_px,
          0.5 * (optics.width_px - 1), 0.5 * (optics.height_px - 1)};
}

Grid<float> depth_image(std::span<std::uint16_t const> counts, int width, int height,
                        CaptureConfig const& config) {
  auto const unit_m =
      static_cast<float>(config.depth_unit_m > 0 ? config.depth_unit_m : kMetresPerCount);
  auto const farthest_m = static_cast<float>(config.max_depth_m);
  Grid<float> depth_m(width, height);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    float const z = static_cast<float>(counts[i]) * unit_m;
    depth_m[i] = counts[i] != 65535 && z <= farthest_m ? z : 0.0F;
  }
  return depth_m;
}

template <typename T>
void mirror(Grid<T>& image) {
  for (int v = 0; v < image.height(); ++v) {
    std::ranges::reverse(image.row(v));
  }
}

template void mirror(Grid<float>&);
template void mirror(Grid<Rgb>&);

}  // namespace credo
