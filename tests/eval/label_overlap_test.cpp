#include "eval/label_overlap.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace credo::test {
namespace {

TEST(LabelOverlap, CountsOnlyWhereTheTruthHasALabel) {
  LabelOverlap const overlap(LabelMap(4, 1, {4000, 4000, 4000, 1}),
                             LabelMap(4, 1, {0, 4005, 4005, 4005}));
  EXPECT_EQ(overlap.size(4000), 2U);
  EXPECT_EQ(overlap.true_sizes().at(4005), 3U);
  EXPECT_EQ(overlap.true_sizes().count(0), 0U);
  ASSERT_TRUE(overlap.best_segment(4005));
  EXPECT_NEAR(overlap.best_segment(4005)->iou, 2.0 / 3.0, 1e-12);
}

TEST(LabelOverlap, WhatIsUnassignedOrWithoutDepthIsNoSegment) {
  LabelOverlap const overlap(LabelMap(3, 1, {0, 1, 1}), LabelMap(3, 1, {3000, 3000, 3000}));
  EXPECT_FALSE(overlap.best_segment(3000));
  EXPECT_FALSE(overlap.largest_segment(3000));
  EXPECT_TRUE(overlap.bodies().empty());
}

TEST(LabelOverlap, TheBestSegmentNeedNotBeTheLargest) {
  // 4000 covers 3 of the thing's 5 pixels and 5 others, 4001 the other two alone.
  LabelOverlap const overlap(
      LabelMap(10, 1, {4000, 4000, 4000, 4001, 4001, 4000, 4000, 4000, 4000, 4000}),
      LabelMap(10, 1, {3000, 3000, 3000, 3000, 3000, 1000, 1000, 1000, 1000, 1000}));
  EXPECT_EQ(overlap.largest_segment(3000)->label, 4000);
  EXPECT_EQ(overlap.best_segment(3000)->label, 4001);
  EXPECT_EQ(overlap.bodies().at(4000), 1000) << "most of it is floor";
  EXPECT_EQ(overlap.bodies().at(4001), 3000);
}

TEST(LabelOverlap, OfEqualsTheLowerLabel) {
  LabelOverlap const overlap(LabelMap(4, 1, {4001, 4001, 4000, 4000}),
                             LabelMap(4, 1, {3000, 3000, 3000, 3000}));
  EXPECT_EQ(overlap.best_segment(3000)->label, 4000);
  EXPECT_EQ(overlap.largest_segment(3000)->label, 4000);
}

TEST(LabelOverlap, ImagesOfDifferentSizesAreRefused) {
  EXPECT_THROW(LabelOverlap(LabelMap(2, 2), LabelMap(4, 1)), std::logic_error);
}

TEST(LabelOverlap, CountsAsPixelByPixel) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> any(0, 3);
  LabelMap labels(31, 17);
  LabelMap truth(31, 17);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    bool const as_before = i > 0 && any(random) > 0;
    labels[i] = as_before ? labels[i - 1] : static_cast<LabelCode>(3998 + any(random));
    truth[i] = as_before ? truth[i - 1] : static_cast<LabelCode>(any(random));
  }
  LabelOverlap const overlap(labels, truth);
  for (int t = 1; t <= 3; ++t) {
    for (int l = 3998; l <= 4001; ++l) {
      std::uint64_t common = 0;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        common += truth[i] == t && labels[i] == l ? 1 : 0;
      }
      auto const found =
          overlap.common().find({static_cast<LabelCode>(t), static_cast<LabelCode>(l)});
      EXPECT_EQ(found == overlap.common().end() ? 0U : found->second, common);
    }
  }
}

}  // namespace
}  // namespace credo::test
