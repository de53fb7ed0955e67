#include "stages/segments/color/cut.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace credo::segments {
namespace {

/// A red bar with a blue leg below its left end, and a leg below its right end.
std::vector<ColorCell> bar_with_legs(float red_of_right_leg) {
  std::vector<ColorCell> cells;
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) {
      if (row < 10) {
        cells.push_back({column, row, 100.0F, 0.5F, 0.3F});
      } else if (column < 4) {
        cells.push_back({column, row, 100.0F, 0.2F, 0.3F});
      } else if (column >= 16) {
        cells.push_back({column, row, 100.0F, red_of_right_leg, 0.3F});
      }
    }
  }
  return cells;
}

TEST(ColorCut, NothingOfAColourIsOnTheOtherSide) {
  EXPECT_TRUE(color_cut(bar_with_legs(0.2F), 0.1).has_value());
  EXPECT_FALSE(color_cut(bar_with_legs(0.5F), 0.1).has_value());
}

}  // namespace
}  // namespace credo::segments
