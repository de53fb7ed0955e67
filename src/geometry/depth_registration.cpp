#include "geometry/depth_registration.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/depth_registration_kernels.hpp"

namespace credo {
namespace {

using depth_registration::Footprints;
using depth_registration::ProjectedRow;
using depth_registration::Warp;

Eigen::Matrix3d camera_matrix(CameraIntrinsics const& camera) {
  if (!(camera.fx_px > 0.0) || !(camera.fy_px > 0.0)) {
    throw std::logic_error("register_depth: focal length " + std::to_string(camera.fx_px) + " x " +
                           std::to_string(camera.fy_px) + " px");
  }
  Eigen::Matrix3d matrix;
  matrix << camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1;
  return matrix;
}

Warp warp_of(DepthCalibration const& calibration, Eigen::Vector2d const& centre_px) {
  Eigen::Matrix3d const color = camera_matrix(calibration.color);
  Eigen::Matrix3d const depth = camera_matrix(calibration.depth);
  Se3 const& T = calibration.T_color_depth;
  Eigen::Matrix3d const turn = color * T.rotation().toRotationMatrix() * depth.inverse();
  auto const at = [&turn](double u, double v) {
    return (turn * Eigen::Vector3d(u, v, 1.0)).hnormalized().eval();
  };
  Eigen::Array2f corner(0.0F, 0.0F);
  // Turning is strongest to see at the corners of the image.
  for (double const u : {0.0, centre_px.x(), 2.0 * centre_px.x()}) {
    for (double const v : {0.0, centre_px.y(), 2.0 * centre_px.y()}) {
      corner.x() =
          std::max(corner.x(), static_cast<float>(std::abs(at(u, v + 1.0).x() - at(u, v).x())));
      corner.y() =
          std::max(corner.y(), static_cast<float>(std::abs(at(u + 1.0, v).y() - at(u, v).y())));
    }
  }
  // Rounding, where nothing is turned.
  corner = (corner < 1e-6F).select(0.0F, corner);
  return {.turn = turn.cast<float>(),
          .shift = (color * T.translation()).cast<float>(),
          .half_px = {static_cast<float>(0.5 * color(0, 0) / depth(0, 0)),
                      static_cast<float>(0.5 * color(1, 1) / depth(1, 1))},
          .corner_px = 0.5F * corner};
}

constexpr float kEmpty = std::numeric_limits<float>::infinity();

/// The nearest depth in each pixel of the colour image, and one more for what falls nowhere.
struct Nearest {
  std::size_t width;
  std::vector<float> depth_m;
};

void draw(Footprints const& footprints, ProjectedRow const& row, Nearest& nearest) {
  std::size_t const nowhere = nearest.depth_m.size() - 1;
  auto const keep_nearest = [&nearest](std::size_t pixel, float depth) {
    nearest.depth_m[pixel] = std::min(nearest.depth_m[pixel], depth);
  };
  for (std::size_t i = 0; i < footprints.u.size(); ++i) {
    float const depth = row.depth_m[i + 1];
    auto const count = static_cast<std::size_t>(footprints.columns[i] * footprints.rows[i]);
    std::size_t const first = static_cast<std::size_t>(footprints.v[i]) * nearest.width +
                              static_cast<std::size_t>(footprints.u[i]);
    // Nearly all cover one pixel or none, at random: no branch tells these two apart.
    if (count <= 1) {
      keep_nearest(nowhere + (first - nowhere) * count, depth);
      continue;
    }
    for (std::size_t v = 0; v < static_cast<std::size_t>(footprints.rows[i]); ++v) {
      for (std::size_t u = 0; u < static_cast<std::size_t>(footprints.columns[i]); ++u) {
        keep_nearest(first + v * nearest.width + u, depth);
      }
    }
  }
}

}  // namespace

DepthCalibration kinect_calibration() {
  constexpr double kBaseline_m = 0.025;
  return {.depth = {575.8, 575.8, 319.5, 239.5},
          .color = {525.0, 525.0, 319.5, 239.5},
          .T_color_depth = Se3(Eigen::Quaterniond::Identity(), {-kBaseline_m, 0.0, 0.0})};
}

DepthCalibration scaled(DepthCalibration const& calibration, double scale) {
  auto const camera = [scale](CameraIntrinsics const& c) {
    // Pixel centres are whole numbers: the image's corner is at -0.5.
    return CameraIntrinsics{scale * c.fx_px, scale * c.fy_px, scale * (c.cx_px + 0.5) - 0.5,
                            scale * (c.cy_px + 0.5) - 0.5};
  };
  return {camera(calibration.depth), camera(calibration.color), calibration.T_color_depth};
}

Grid<float> register_depth(Grid<float> const& depth_m, DepthCalibration const& calibration,
                           int width, int height) {
  Warp const warp =
      warp_of(calibration, 0.5 * Eigen::Vector2d(depth_m.width() - 1, depth_m.height() - 1));
  std::size_t const pixels = Grid<char>(width, height).size();
  Nearest nearest{.width = static_cast<std::size_t>(width),
                  .depth_m = std::vector<float>(pixels + 1, kEmpty)};
  auto const columns = static_cast<std::size_t>(depth_m.width());
  ProjectedRow above(columns);
  ProjectedRow row(columns);
  ProjectedRow below(columns);
  Footprints footprints(columns);
  Eigen::Array2f const size_px(static_cast<float>(width), static_cast<float>(height));
  for (int v = -1; v < depth_m.height(); ++v) {
    if (v + 1 < depth_m.height()) {
      project(depth_m.row(v + 1), v + 1, warp, below);
    } else {
      below = ProjectedRow(columns);
    }
    if (v >= 0) {
      find_footprints(above, row, below, warp, size_px, footprints);
      draw(footprints, row, nearest);
    }
    std::swap(above, row);
    std::swap(row, below);
  }
  nearest.depth_m.pop_back();
  std::ranges::transform(nearest.depth_m, nearest.depth_m.begin(),
                         [](float depth) { return depth < kEmpty ? depth : 0.0F; });
  return {width, height, nearest.depth_m};
}

}  // namespace credo
