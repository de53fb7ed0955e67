#pragma once

#include <cstddef>
#include <span>

#include "core/cloud.hpp"
#include "core/se3.hpp"
#include "geometry/cell_sums.hpp"

namespace credo {

/// Pixels `begin` to before `end` of an image in raster order, all of one row.
struct PixelRun {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Which of a surface's pixels are summed up: as many as its cells need, far fewer than a surface
/// close by has.
struct PixelSampling {
  /// Of the cells.
  float spacing_m = 0.0F;
  /// Of the camera, in pixels; 0 for all pixels, however many.
  float focal_px = 0.0F;

  /// 1, 2 or 4: of a surface at this depth that faces the camera, every so manieth pixel of every
  /// so manieth row puts one and a half or more a side into each cell.
  [[nodiscard]] std::size_t step_px(float depth_m) const {
    constexpr float kPerCell = 1.5F;
    float const spacing_px = focal_px * spacing_m / kPerCell;
    return 4.0F * depth_m <= spacing_px ? 4 : 2.0F * depth_m <= spacing_px ? 2 : 1;
  }
};

/// The points of `runs`, in their order, in cells of the frame `T_grid_camera` leads to. Of each
/// run the pixels that its first one's depth asks for (PixelSampling::step_px, counted from the
/// image's first row and column); but all of all runs where that makes few cells (kFewCells):
/// what is small or thin keeps whatever it has. Points of `cloud` (camera frame) are finite in the
/// runs. No runs give no cells.
[[nodiscard]] CellSums sampled_cells(OrganizedCloud const& cloud, std::span<PixelRun const> runs,
                                     PixelSampling const& sampling, Se3 const& T_grid_camera);

/// At 2 cm a thing the size of a sheet of paper.
inline constexpr std::size_t kFewCells = 128;

}  // namespace credo
