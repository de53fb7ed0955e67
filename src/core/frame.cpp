#include "core/frame.hpp"

#include <utility>

namespace credo {

OrganizedCloud cloud_from_depth(Grid<float> depth_m, CameraIntrinsics const& intrinsics) {
  int const width = depth_m.width();
  int const height = depth_m.height();
  std::vector<float> x_per_z(static_cast<std::size_t>(width));
  for (int u = 0; u < width; ++u) {
    x_per_z[static_cast<std::size_t>(u)] =
        static_cast<float>((u - intrinsics.cx_px) / intrinsics.fx_px);
  }
  OrganizedCloud cloud;
  cloud.x = Grid<float>::unset(width, height);
  cloud.y = Grid<float>::unset(width, height);
  for (int v = 0; v < height; ++v) {
    auto const y_per_z = static_cast<float>((v - intrinsics.cy_px) / intrinsics.fy_px);
    float* z = depth_m.row(v).data();
    float* x = cloud.x.row(v).data();
    float* y = cloud.y.row(v).data();
    for (std::size_t u = 0; u < x_per_z.size(); ++u) {
      // One comparison catches zero, negative, NaN and infinite depth.
      float const depth = z[u] > 0.0F && z[u] < 1e6F ? z[u] : kNaN;
      z[u] = depth;
      x[u] = depth * x_per_z[u];
      y[u] = depth * y_per_z;
    }
  }
  cloud.z = std::move(depth_m);
  return cloud;
}

}  // namespace credo
