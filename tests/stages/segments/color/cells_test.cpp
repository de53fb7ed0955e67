#include "stages/segments/color/cells.hpp"

#include <gtest/gtest.h>

namespace credo::segments {
namespace {

constexpr double kQuantum_per_m = 0.01;

TEST(ColorCells, AreSquaresOfOneLabel) {
  // Two columns of squares and a rest of two pixels; the second column has another label in one
  // square, and none in the other.
  Segments segments;
  segments.labels = Grid<std::int32_t>(10, 8, 1);
  for (int v = 0; v < 8; ++v) {
    for (int u = 4; u < 10; ++u) {
      segments.labels[Pixel{u, v}] = 2;
    }
  }
  segments.labels[Pixel{7, 7}] = 0;
  Grid<float> const depth_m(10, 8, 2.0F);
  Grid<Rgb> color(10, 8, Rgb{100, 60, 40});
  auto const cells = color_cells(segments, depth_m, color, 4, kQuantum_per_m, {false, true, true});
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_TRUE(cells[0].empty());
  ASSERT_EQ(cells[1].size(), 2U);
  ASSERT_EQ(cells[2].size(), 1U);
  EXPECT_EQ(cells[1][1].column, 0);
  EXPECT_EQ(cells[1][1].row, 1);
  EXPECT_EQ(cells[2][0].column, 1);
  EXPECT_EQ(cells[2][0].row, 0);
  EXPECT_FLOAT_EQ(cells[1][0].quanta, 50.0F);
  EXPECT_FLOAT_EQ(cells[1][0].red, 0.5F);
  EXPECT_FLOAT_EQ(cells[1][0].green, 0.3F);
  EXPECT_TRUE(
      color_cells(segments, depth_m, color, 4, kQuantum_per_m, {false, false, true})[1].empty());
}

TEST(ColorCells, TooDarkToTell) {
  Segments segments;
  segments.labels = Grid<std::int32_t>(8, 4, 1);
  Grid<float> const depth_m(8, 4, 1.0F);
  Grid<Rgb> color(8, 4, Rgb{30, 30, 30});
  color[Pixel{4, 0}] = {29, 30, 30};
  auto const cells = color_cells(segments, depth_m, color, 4, kQuantum_per_m, {false, true});
  ASSERT_EQ(cells[1].size(), 2U);
  EXPECT_TRUE(cells[1][0].has_color());
  EXPECT_FALSE(cells[1][1].has_color());
}

}  // namespace
}  // namespace credo::segments
