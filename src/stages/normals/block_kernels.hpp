#pragma once

#include <array>
#include <cstddef>

#include "stages/normals/depth_tolerance.hpp"

// Kernels on one row of blocks of 2x2 pixels, compiled once per instruction set and chosen at run
// time. Every column is computed by itself, in a fixed order of operations and without fused
// multiply-adds: the bytes are the same on every machine. Rows of blocks must be readable and
// writable up to padded_lanes(count) elements, rows of pixels up to twice that.

namespace credo::normals {

/// `count` rounded up to whole vectors of the widest instruction set.
[[nodiscard]] constexpr std::size_t padded_lanes(std::size_t count) {
  return (count + 15) / 16 * 16;
}

/// Two rows of depth [m]. Depths below 1 mm, above 1000 km and NaN are invalid.
struct PixelRows {
  float const* top_m = nullptr;
  float const* bottom_m = nullptr;
};

/// How a row of blocks splits into the surface nearest to the camera in each 2x2 pixels, and the
/// next one behind it where depth jumps inside the block.
struct SplitRow {
  /// A pixel belongs to the surface up to this depth [m]; 0 where there is none.
  float* near_limit_m = nullptr;
  float* far_limit_m = nullptr;
  /// Mean inverse depth of the far surface's pixels [1/m], kNothing where there is none.
  float* far_w = nullptr;
};

/// One row of vectors: x, y, z.
using VectorRow = std::array<float*, 3>;
using ConstVectorRow = std::array<float const*, 3>;

/// Mean inverse depth [1/m] of the near surface of each block, kNothing where there is none.
void make_blocks(PixelRows const& pixels, std::size_t count, DepthTolerance tolerance,
                 float* near_w);

void split_blocks(PixelRows const& pixels, std::size_t count, DepthTolerance tolerance,
                  SplitRow const& out);

/// Mean inverse depth of the nearest surface among four samples: the columns u + left and u + right
/// of two rows, which must be readable there too.
void merge_blocks(float const* top, float const* bottom, int left, int right, std::size_t count,
                  DepthTolerance tolerance, float* out);

/// Gives the normals of a row of blocks to one of its two rows of pixels: each pixel takes that of
/// the surface to which its depth belongs, NaN where it belongs to neither.
void spread_normals(float const* depth_m, SplitRow const& blocks, ConstVectorRow const& near,
                    ConstVectorRow const& far, std::size_t count, VectorRow const& out);

}  // namespace credo::normals
