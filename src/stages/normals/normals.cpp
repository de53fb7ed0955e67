#include "stages/normals/normals.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stages/normals/block_image.hpp"
#include "stages/normals/block_kernels.hpp"
#include "stages/normals/plane_kernel.hpp"

namespace credo {
namespace {

normals::FitParams fit_params(CameraIntrinsics const& intrinsics, NormalsConfig const& config) {
  if (!(intrinsics.fx_px > 0.0) || !(intrinsics.fy_px > 0.0)) {
    throw std::logic_error("estimate_normals: focal lengths " + std::to_string(intrinsics.fx_px) +
                           " and " + std::to_string(intrinsics.fy_px) + " px must be positive");
  }
  normals::FitParams params;
  params.tolerance = {config.max_depth_jump_m, config.depth_noise_per_m};
  params.radius_focal_m_px =
      static_cast<float>(0.5 * (intrinsics.fx_px + intrinsics.fy_px)) * config.radius_m;
  params.min_radius_px = config.min_radius_px;
  params.max_radius_px = config.max_radius_px;
  params.min_support = config.min_support;
  params.fx_px = static_cast<float>(intrinsics.fx_px);
  params.fy_px = static_cast<float>(intrinsics.fy_px);
  params.cx_px = static_cast<float>(intrinsics.cx_px);
  params.cy_px = static_cast<float>(intrinsics.cy_px);
  return params;
}

/// One row of vectors, padded.
class RowBuffer {
public:
  explicit RowBuffer(std::size_t count) : count_(count), data_(3 * count) {}
  [[nodiscard]] normals::VectorRow rows() {
    return {data_.data(), data_.data() + count_, data_.data() + 2 * count_};
  }
  [[nodiscard]] normals::ConstVectorRow rows() const {
    return {data_.data(), data_.data() + count_, data_.data() + 2 * count_};
  }

private:
  std::size_t count_;
  std::vector<float> data_;
};

void copy_row(normals::ConstVectorRow const& from, int v, NormalMap& to) {
  auto const width = static_cast<std::size_t>(to.width());
  std::copy_n(from[0], width, to.x.row(v).data());
  std::copy_n(from[1], width, to.y.row(v).data());
  std::copy_n(from[2], width, to.z.row(v).data());
}

}  // namespace

NormalMap estimate_normals(OrganizedCloud const& cloud, CameraIntrinsics const& intrinsics,
                           NormalsConfig const& config) {
  normals::FitParams const params = fit_params(intrinsics, config);
  normals::BlockImage image = normals::make_block_image(cloud.z, params.tolerance);
  NormalMap result(cloud.width(), cloud.height());
  auto const count = static_cast<std::size_t>(image.width);
  std::size_t const padded = normals::padded_lanes(count);

  constexpr int kRowsPerTask = 8;
  tbb::parallel_for(tbb::blocked_range<int>(0, image.height, kRowsPerTask), [&](auto const& rows) {
    RowBuffer near(padded);
    RowBuffer far(padded);
    RowBuffer pixels(2 * padded);
    std::vector<float> depth_m;
    for (int v = rows.begin(); v < rows.end(); ++v) {
      normals::BlockRow const blocks = image.row(v);
      normals::LevelRows const samples = image.level_rows(v);
      normals::fit_normals(samples, v, blocks.near_w, count, params, near.rows());
      normals::fit_normals(samples, v, blocks.far_w, count, params, far.rows());
      for (int pixel_v = 2 * v; pixel_v < std::min(2 * v + 2, cloud.height()); ++pixel_v) {
        normals::copy_depth_row(cloud.z, pixel_v, depth_m);
        normals::spread_normals(depth_m.data(), blocks, std::as_const(near).rows(),
                                std::as_const(far).rows(), count, pixels.rows());
        copy_row(std::as_const(pixels).rows(), pixel_v, result);
      }
    }
  });
  return result;
}

FieldList fields(NormalsConfig& config) {
  return {
      {"radius_m",
       &config.radius_m,
       {0.001, 1},
       "m",
       "half the width of the neighbourhood that a normal is fitted to"},
      {"min_radius_px",
       &config.min_radius_px,
       {2, normals::kMaxRadiusPx},
       "px",
       "least half width of the neighbourhood in the image, for surfaces far away"},
      {"max_radius_px",
       &config.max_radius_px,
       {2, normals::kMaxRadiusPx},
       "px",
       "greatest half width of the neighbourhood in the image, for surfaces close by"},
      {"max_depth_jump_m",
       &config.max_depth_jump_m,
       {0, 1},
       "m",
       "points whose depth differs by more, beyond noise, belong to another surface"},
      {"depth_noise_per_m",
       &config.depth_noise_per_m,
       {0, 1},
       "1/m",
       "scatter of inverse depth that counts as noise, about 3 steps of the sensor's disparity"},
      {"min_support",
       &config.min_support,
       {0.05, 1},
       "",
       "least share of the neighbourhood that must belong to the surface"},
  };
}

}  // namespace credo
