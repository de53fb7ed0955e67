#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/grid.hpp"
#include "stages/normals/block_kernels.hpp"
#include "stages/normals/plane_kernel.hpp"

namespace credo::normals {

/// A row-major image of inverse depths [1/m] within a margin of kNothing, so that windows and whole
/// vectors may reach beyond it without a check. Each row is to be written and ended before it is
/// read.
class PaddedImage {
public:
  PaddedImage() = default;
  PaddedImage(int width, int height, int margin);

  /// Column 0 of a row; rows and columns from -margin on may be read.
  [[nodiscard]] float* row(int v) { return data_.get() + origin(v); }
  [[nodiscard]] float const* row(int v) const { return data_.get() + origin(v); }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  /// Clears what the last vector wrote beyond the image, or left unwritten.
  void end_row(int v, int width);

private:
  [[nodiscard]] std::ptrdiff_t origin(int v) const { return (v + margin_) * stride_ + margin_; }

  int margin_ = 0;
  std::ptrdiff_t stride_ = 0;
  // Not a vector: that would write every value twice.
  std::unique_ptr<float[]> data_;
};

/// A depth image as blocks of 2x2 pixels in inverse depth, where planes are exactly affine.
struct BlockImage {
  int width = 0;
  int height = 0;
  /// The nearest surface of each block [1/m]. Level i is its mean over the 2^i x 2^i blocks
  /// around each block (columns and rows -2^(i-1) to 2^(i-1) - 1), as far as they are one surface.
  std::array<PaddedImage, kLevels> levels;

  [[nodiscard]] LevelRows level_rows(int v) const;
};

/// Depth in metres; not positive or not finite = invalid. An odd last column or row is filled up
/// with invalid pixels.
BlockImage make_block_image(Grid<float> const& depth_m, DepthTolerance tolerance);

/// Space for two rows of depth.
using PixelRowsSpace = std::array<std::vector<float>, 2>;

/// The pixels of a row of blocks as the kernels want them: padded with NaN; all NaN beyond the
/// image. Valid as long as the image and the space.
PixelRows pixel_rows(Grid<float> const& depth_m, int block_v, PixelRowsSpace& space);

}  // namespace credo::normals
