#pragma once

#include <cstdint>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/segments.hpp"

namespace credo::segments {

/// A small square of the image, all of one segment.
struct ColorCell {
  /// Counted in squares.
  int column = 0;
  int row = 0;
  /// Mean inverse depth.
  float quanta = 0.0F;
  /// Shares of red and green in all light; negative where it is too dark to tell.
  float red = -1.0F;
  float green = -1.0F;

  [[nodiscard]] bool has_color() const { return red >= 0.0F; }
};

/// For each label its squares of `side_px`, by row and column; none for labels that are not
/// `wanted`. A mean over a square has little of the camera's noise left. `depth_m` and `color` are
/// as large as the labels, `wanted` is as long as there are labels, 0 included.
[[nodiscard]] std::vector<std::vector<ColorCell>> color_cells(Segments const& segments,
                                                              Grid<float> const& depth_m,
                                                              Grid<Rgb> const& color, int side_px,
                                                              double quantum_per_m,
                                                              std::vector<bool> const& wanted);

}  // namespace credo::segments
