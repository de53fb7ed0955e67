#include "stages/fusion/stuff/shown_steps.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/label.hpp"

namespace credo {
namespace {

/// Of the first thing the blocks on the left are, of the second those on the right; the rows end
/// `steps_m` farther away than they begin.
ShownSteps shown(std::vector<float> const& steps_m, LabelCode right = kFirstStuff) {
  auto const rows = static_cast<int>(steps_m.size());
  Sight sight;
  sight.depth_m = Grid<float>(4, rows, 2.0F);
  sight.labels = LabelMap(4, rows, kFirstStuff);
  Grid<std::int32_t> owners(4, rows, 0);
  for (int v = 0; v < rows; ++v) {
    for (int u = 2; u < 4; ++u) {
      sight.depth_m[{u, v}] += steps_m[static_cast<std::size_t>(v)];
      sight.labels[{u, v}] = right;
      owners[{u, v}] = 1;
    }
  }
  return {sight, owners};
}

// 1 cm and 1 % of 2 m.
TEST(ShownSteps, StandApartWhereDepthLeaps) {
  EXPECT_TRUE(shown({0.04F, 0.04F, 0.04F}).stand_apart(0, 1));
  EXPECT_TRUE(shown({0.04F, 0.04F, 0.04F}).stand_apart(1, 0));
  EXPECT_TRUE(shown({-0.04F, -0.04F, -0.04F}).stand_apart(0, 1));
  EXPECT_FALSE(shown({0.02F, 0.02F, 0.02F}).stand_apart(0, 1));
}

TEST(ShownSteps, MostOfTheBorderDecides) {
  EXPECT_TRUE(shown({0.04F, 0.04F, 0.0F}).stand_apart(0, 1));
  EXPECT_FALSE(shown({0.04F, 0.0F, 0.0F}).stand_apart(0, 1));
  EXPECT_FALSE(shown({0.04F, 0.0F}).stand_apart(0, 1));
}

TEST(ShownSteps, WithoutABorderInOneClusterNothingIsSaid) {
  EXPECT_FALSE(shown({0.04F, 0.04F}, kFirstStuff + 1).stand_apart(0, 1));
  EXPECT_FALSE(shown({0.04F, 0.04F}).stand_apart(0, 2));
  EXPECT_FALSE(shown({}).stand_apart(0, 1));
}

}  // namespace
}  // namespace credo
