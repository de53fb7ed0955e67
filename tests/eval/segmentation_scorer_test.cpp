#include "eval/segmentation_scorer.hpp"

#include <gtest/gtest.h>

namespace credo::test {
namespace {

TEST(OverlapScorer, FramesCountAlikeAndFramesWithoutInstancesNotAtAll) {
  OverlapScorer scorer;
  LabelMap const truth(4, 1, {3000, 3000, 3000, 3000});
  scorer.add(LabelOverlap(truth, truth), {3000});
  scorer.add(LabelOverlap(LabelMap(4, 1, {4000, 4000, 4001, 1}), truth), {3000});
  scorer.add(LabelOverlap(truth, LabelMap(4, 1, LabelCode{1000})), {3000});
  ASSERT_TRUE(scorer.scores());
  EXPECT_NEAR(scorer.scores()->weighted_overlap, 0.5 * (1.0 + 0.5), 1e-12);
  EXPECT_NEAR(scorer.scores()->over_segmentation, 0.5 * (0.0 + 0.5), 1e-12);
  EXPECT_FALSE(OverlapScorer().scores());
}

TEST(OverlapScorer, ASegmentThatSwallowsTwoIsForeignToBoth) {
  OverlapScorer scorer;
  scorer.add(LabelOverlap(LabelMap(4, 1, {1000, 1000, 1000, 1000}),
                          LabelMap(4, 1, {3000, 3001, 1000, 1000})),
             {3000, 3001});
  EXPECT_NEAR(scorer.scores()->under_segmentation, (3.0 + 3.0) / 2.0, 1e-12);
  EXPECT_EQ(scorer.scores()->over_segmentation, 0.0);
}

TEST(ClassScorer, PoolsPixelsOverFrames) {
  ClassScorer scorer;
  std::map<LabelCode, PixelClass> const classes = {{1000, PixelClass::kGround},
                                                   {4000, PixelClass::kStuff}};
  scorer.add(
      LabelOverlap(LabelMap(4, 1, {1000, 1000, 4007, 1}), LabelMap(4, 1, {1000, 1000, 4000, 4000})),
      classes);
  scorer.add(LabelOverlap(LabelMap(2, 1, {2000, 1000}), LabelMap(2, 1, {1000, 4000})), classes);
  EXPECT_NEAR(scorer.iou().at("floor"), 2.0 / 4.0, 1e-12);
  EXPECT_NEAR(scorer.iou().at("stuff"), 1.0 / 3.0, 1e-12);
  EXPECT_EQ(scorer.iou().count("wall"), 0U) << "the truth has none";
}

}  // namespace
}  // namespace credo::test
