#pragma once

#include <functional>

#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/segments.hpp"

namespace credo::test {

/// What one quantum of inverse depth is; that of SegmentsConfig.
inline constexpr double kQuantum_per_m = 0.00287;

/// Depth whose inverse is that many quanta at a pixel; invalid where these are not positive.
Grid<float> depth_of_quanta(int width, int height, std::function<double(Pixel)> const& quanta);

/// Planes at any angle in pieces of any shape, with noise of about a quantum and holes.
Grid<float> random_planes(int width, int height, unsigned seed);

/// Every pixel for itself, between 0.5 and 5 m; one in ten without depth.
Grid<float> depth_noise(int width, int height, unsigned seed);

/// Cells at 1 m and at 1.5 m by turns.
Grid<float> checkerboard(int width, int height, int cell_px);

/// A wall with little plates that rise from it behind a groove, each of which is a part of its own
/// at first.
Grid<float> grooved_wall(int width, int height);

/// From right to left.
template <typename T>
Grid<T> mirrored(Grid<T> const& image) {
  Grid<T> result(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    Pixel const p = image.pixel(i);
    result[Pixel{image.width() - 1 - p.u, p.v}] = image[i];
  }
  return result;
}

}  // namespace credo::test
