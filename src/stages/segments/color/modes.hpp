#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "stages/segments/color/cells.hpp"

namespace credo::segments {

/// Which of a few colours each cell has.
struct ColorModes {
  int count = 0;
  /// From 0; negative where a cell has none of them.
  std::vector<int> of_cell;
};

/// The two or three colours that nearly all cells have: `apart` from each other (Euclid, in shares
/// of red and green), with little scatter around each. None where there is one colour, or where
/// there are many, as on what is printed; nor where it is mostly dark. Light and shade change none
/// of it.
[[nodiscard]] std::optional<ColorModes> color_modes(std::span<ColorCell const> cells, double apart);

}  // namespace credo::segments
