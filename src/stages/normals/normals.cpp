#include "stages/normals/normals.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
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

/// Several rows of floats as one piece of memory.
template <std::size_t kRows>
class RowSpace {
public:
  explicit RowSpace(std::size_t count) : data_(kRows * count) {
    for (std::size_t i = 0; i < kRows; ++i) {
      rows_[i] = data_.data() + i * count;
    }
  }
  [[nodiscard]] std::array<float*, kRows> const& rows() const { return rows_; }

private:
  std::vector<float> data_;
  std::array<float*, kRows> rows_{};
};

normals::ConstVectorRow read_only(normals::VectorRow const& row) {
  return {row[0], row[1], row[2]};
}

/// Computes the normals of one row of blocks after the other.
class RowWorker {
public:
  RowWorker(Grid<float> const& depth_m, normals::BlockImage const& image,
            normals::FitParams const& params, NormalMap& result)
      : depth_m_(depth_m),
        image_(image),
        params_(params),
        result_(result),
        count_(static_cast<std::size_t>(image.width)),
        split_(normals::padded_lanes(count_)),
        near_(normals::padded_lanes(count_)),
        far_(normals::padded_lanes(count_)),
        pixels_(2 * normals::padded_lanes(count_)) {}

  /// Writes the one or two rows of the result that block row v covers.
  void operator()(int v) {
    normals::PixelRows const depth = normals::pixel_rows(depth_m_, v, depth_space_);
    auto const [near_limit_m, far_limit_m, far_w] = split_.rows();
    normals::SplitRow const split{near_limit_m, far_limit_m, far_w};
    normals::split_blocks(depth, count_, params_.tolerance, split);
    normals::LevelRows const samples = image_.level_rows(v);
    normals::fit_normals(samples, v, samples.levels[0], count_, params_, near_.rows());
    normals::fit_normals(samples, v, far_w, count_, params_, far_.rows());
    spread(depth.top_m, split, 2 * v);
    if (2 * v + 1 < depth_m_.height()) {
      spread(depth.bottom_m, split, 2 * v + 1);
    }
  }

private:
  void spread(float const* depth_m, normals::SplitRow const& split, int pixel_v) {
    normals::VectorRow const row{result_.x.row(pixel_v).data(), result_.y.row(pixel_v).data(),
                                 result_.z.row(pixel_v).data()};
    auto const width = static_cast<std::size_t>(result_.width());
    bool const whole_vectors = width == 2 * normals::padded_lanes(count_);
    normals::spread_normals(depth_m, split, read_only(near_.rows()), read_only(far_.rows()), count_,
                            whole_vectors ? row : pixels_.rows());
    for (std::size_t i = 0; i < row.size() && !whole_vectors; ++i) {
      std::copy_n(pixels_.rows()[i], width, row[i]);
    }
  }

  Grid<float> const& depth_m_;
  normals::BlockImage const& image_;
  normals::FitParams const& params_;
  NormalMap& result_;
  std::size_t count_;
  normals::PixelRowsSpace depth_space_;
  RowSpace<3> split_;
  RowSpace<3> near_;
  RowSpace<3> far_;
  RowSpace<3> pixels_;
};

}  // namespace

NormalMap estimate_normals(OrganizedCloud const& cloud, CameraIntrinsics const& intrinsics,
                           NormalsConfig const& config) {
  normals::FitParams const params = fit_params(intrinsics, config);
  normals::BlockImage const image = normals::make_block_image(cloud.z, params.tolerance);
  NormalMap result{VectorGrid::unset(cloud.width(), cloud.height())};
  constexpr int kRowsPerTask = 8;
  tbb::parallel_for(tbb::blocked_range<int>(0, image.height, kRowsPerTask), [&](auto const& rows) {
    RowWorker work(cloud.z, image, params, result);
    for (int v = rows.begin(); v < rows.end(); ++v) {
      work(v);
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
