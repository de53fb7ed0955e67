#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "core/cloud.hpp"
#include "core/plane.hpp"
#include "core/se3.hpp"
#include "geometry/cell_sums.hpp"

namespace credo {

/// Pixels `begin` to before `end` of an image in raster order, all of one row.
struct PixelRun {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Every so manieth pixel of a row, of every so manieth row.
struct PixelSteps {
  std::size_t u = 1;
  std::size_t v = 1;

  friend bool operator==(PixelSteps const&, PixelSteps const&) = default;
};

/// Which of a surface's pixels are summed up: as many as its cells need, far fewer than a surface
/// close by has.
struct PixelSampling {
  /// Of the cells.
  float spacing_m = 0.0F;
  /// Of the camera, in pixels; 0 for all pixels, however many.
  float focal_px = 0.0F;
  /// Of a plane (camera frame), its normal by its offset; 0 for what faces the camera, or may.
  Eigen::Vector3f slant_per_m = Eigen::Vector3f::Zero();

  /// Of the plane that the pixels show.
  [[nodiscard]] static PixelSampling of_plane(float spacing_m, float focal_px,
                                              Plane const& plane_camera) {
    return {spacing_m, focal_px, (plane_camera.normal / plane_camera.offset_m).cast<float>()};
  }

  /// 1, 2 or 4 each: around a point of the surface (camera frame) so many pixels put one and a half
  /// or more a side into each cell. All of a plane that the camera is in.
  ///
  /// Where the plane n p = d is seen at P, a pixel further is z / f (e - n_e / d P) on it.
  [[nodiscard]] PixelSteps steps_px(Eigen::Vector3f const& p_camera) const {
    return {step_px(0, p_camera), step_px(1, p_camera)};
  }
  /// Along the rows (axis 0), or from row to row.
  [[nodiscard]] std::size_t step_px(Eigen::Index axis, Eigen::Vector3f const& p_camera) const {
    constexpr float kPerCell = 1.5F;
    float const spacing_px = focal_px * spacing_m / kPerCell;
    Eigen::Vector3f const along = Eigen::Vector3f::Unit(axis) - slant_per_m[axis] * p_camera;
    float const apart_m = p_camera.z() * along.norm();
    return 4.0F * apart_m <= spacing_px ? 4 : 2.0F * apart_m <= spacing_px ? 2 : 1;
  }
};

/// The points of `runs`, in their order, in cells of the frame `T_grid_camera` leads to. Of each
/// run the pixels that its first one asks for (PixelSampling::steps_px, counted from the image's
/// first row and column); but all of all runs where that makes few cells (kFewCells):
/// what is small or thin keeps whatever it has. Points of `cloud` (camera frame) are finite in the
/// runs. No runs give no cells.
[[nodiscard]] CellSums sampled_cells(OrganizedCloud const& cloud, std::span<PixelRun const> runs,
                                     PixelSampling const& sampling, Se3 const& T_grid_camera);

/// At 2 cm a thing the size of a sheet of paper.
inline constexpr std::size_t kFewCells = 128;

}  // namespace credo
