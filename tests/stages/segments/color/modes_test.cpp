#include "stages/segments/color/modes.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace credo::segments {
namespace {

void add(std::vector<ColorCell>& cells, int count, float red) {
  for (int i = 0; i < count; ++i) {
    cells.push_back({static_cast<int>(cells.size()), 0, 100.0F, red, 0.33F});
  }
}

TEST(ColorModes, AreThoseOfNearlyAllCells) {
  std::vector<ColorCell> cells;
  add(cells, 60, 0.33F);
  add(cells, 40, 0.45F);
  add(cells, 10, 0.39F);
  auto const modes = color_modes(cells, 0.1);
  ASSERT_TRUE(modes.has_value());
  EXPECT_EQ(modes->count, 2);
  EXPECT_EQ(modes->of_cell.front(), 0) << "the most frequent first";
  EXPECT_EQ(modes->of_cell[70], 1);
  EXPECT_EQ(modes->of_cell.back(), -1);
  add(cells, 10, 0.39F);
  EXPECT_FALSE(color_modes(cells, 0.1).has_value()) << "20 of 120 between the two";
}

TEST(ColorModes, CellsWithoutColourHaveNone) {
  std::vector<ColorCell> cells;
  add(cells, 60, 0.33F);
  add(cells, 40, 0.45F);
  add(cells, 10, -1.0F);
  auto const modes = color_modes(cells, 0.1);
  ASSERT_TRUE(modes.has_value());
  EXPECT_EQ(modes->of_cell.back(), -1);
  add(cells, 20, -1.0F);
  EXPECT_FALSE(color_modes(cells, 0.1).has_value());
}

TEST(ColorModes, TheirMeansAreApart) {
  // 0.432 is far enough from 0.33, the mean of what is around it is not.
  std::vector<ColorCell> cells;
  add(cells, 60, 0.33F);
  add(cells, 30, 0.432F);
  EXPECT_TRUE(color_modes(cells, 0.1).has_value());
  add(cells, 30, 0.42F);
  EXPECT_FALSE(color_modes(cells, 0.1).has_value());
}

TEST(ColorModes, OneColourOrNoCellsAreNone) {
  std::vector<ColorCell> cells;
  EXPECT_FALSE(color_modes(cells, 0.1).has_value());
  add(cells, 100, 0.33F);
  EXPECT_FALSE(color_modes(cells, 0.1).has_value());
  add(cells, 6, 0.6F);
  EXPECT_FALSE(color_modes(cells, 0.1).has_value()) << "a spot";
}

}  // namespace
}  // namespace credo::segments
