#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/grid.hpp"
#include "stages/normals/block_kernels.hpp"
#include "stages/normals/plane_kernel.hpp"

namespace credo::normals {

/// A row-major image of floats within a margin, so that windows and whole vectors may reach beyond
/// it without a check.
class PaddedImage {
public:
  PaddedImage() = default;
  PaddedImage(int width, int height, int margin, float value);

  /// Column 0 of a row; rows and columns from -margin on may be read.
  [[nodiscard]] float* row(int v) { return data_.data() + origin(v); }
  [[nodiscard]] float const* row(int v) const { return data_.data() + origin(v); }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }

private:
  [[nodiscard]] std::ptrdiff_t origin(int v) const { return (v + margin_) * stride_ + margin_; }

  int margin_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<float> data_;
};

/// A depth image as blocks of 2x2 pixels in inverse depth, where planes are exactly affine.
struct BlockImage {
  int width = 0;
  int height = 0;
  /// The nearest surface of each block [1/m]. Level i is its mean over the 2^i x 2^i blocks
  /// around each block (columns and rows -2^(i-1) to 2^(i-1) - 1), as far as they are one surface.
  std::array<PaddedImage, kLevels> levels;
  /// The surface behind it [1/m]; and up to which depth a pixel belongs to either [m].
  PaddedImage far_w;
  PaddedImage near_limit_m;
  PaddedImage far_limit_m;

  [[nodiscard]] BlockRow row(int v) {
    return {levels[0].row(v), far_w.row(v), near_limit_m.row(v), far_limit_m.row(v)};
  }
  [[nodiscard]] LevelRows level_rows(int v) const;
};

/// Depth in metres; not positive or not finite = invalid. An odd last column or row is filled up
/// with invalid pixels.
BlockImage make_block_image(Grid<float> const& depth_m, DepthTolerance tolerance);

/// A row of depth as the kernels want it: padded with NaN; all NaN beyond the image.
void copy_depth_row(Grid<float> const& depth_m, int v, std::vector<float>& out);

}  // namespace credo::normals
