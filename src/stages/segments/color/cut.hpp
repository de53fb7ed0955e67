#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "stages/segments/color/cells.hpp"

namespace credo::segments {

/// A plane in space between two things: over column, row and inverse depth planes are planes too.
struct ColorCut {
  Eigen::Vector4d plane;

  /// Positive on one side. Column and row in squares, as cells have them, and parts of these.
  [[nodiscard]] double side(double column, double row, double quanta) const {
    return plane.dot(Eigen::Vector4d(column, row, quanta, 1.0));
  }
};

/// The plane that parts the cells of one segment by their colours. It is between one colour, on its
/// positive side, and the others, which lie on its two sides but for a few cells; both sides are
/// large, and the surface goes on flat across it. So a print within a face is none, nor a pattern,
/// nor a box whose faces have different colours, since they meet in an edge. None where in doubt.
[[nodiscard]] std::optional<ColorCut> color_cut(std::span<ColorCell const> cells, double apart);

}  // namespace credo::segments
