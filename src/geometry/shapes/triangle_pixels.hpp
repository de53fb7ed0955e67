#pragma once

#include <cstddef>

namespace credo {

/// A value that is affine in the image.
struct AffineInImage {
  float at_corner = 0.0F;
  float per_u = 0.0F;
  float per_v = 0.0F;
};

/// A triangle's box of pixels, and what is affine in it from the box's top left pixel on.
struct TriangleInImage {
  int width_px = 0;
  int height_px = 0;
  /// The three weights of the corners: a pixel is in the triangle where none is negative.
  AffineInImage a;
  AffineInImage b;
  AffineInImage c;
  /// Inverse depth, 1/m.
  AffineInImage per_m;
};

/// So many floats after a row's last one may be read and written again as they were.
inline constexpr std::size_t kTrianglePadding = 16;

/// Raises what lies under the triangle to its inverse depth. `nearest_per_m` is the box's top left
/// pixel in rows `stride` floats apart, which end kTrianglePadding floats after the box at least.
/// The same bits on every instruction set.
void draw_triangle(TriangleInImage const& triangle, float* nearest_per_m, std::size_t stride);

}  // namespace credo
