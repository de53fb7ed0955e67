#include "stages/segments/settling.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace credo::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

constexpr LabelCode kTable = kFirstObject;
constexpr LabelCode kBox = kFirstObject + 1;

/// A row of ten pixels in one segment, of two known objects.
Segmentation row_of(std::vector<LabelCode> labels, std::int32_t segment = 1) {
  Segmentation segmentation;
  auto const width = static_cast<int>(labels.size());
  segmentation.labels = LabelMap(width, 1, std::move(labels));
  segmentation.segments.labels = Grid<std::int32_t>(width, 1, segment);
  segmentation.segments.pixel_counts = {static_cast<std::uint32_t>(width)};
  segmentation.objects.resize(2);
  segmentation.objects[0].label = kTable;
  segmentation.objects[1].label = kBox;
  return segmentation;
}

std::vector<LabelCode> pixels(int table, int box, int rest) {
  std::vector<LabelCode> labels(static_cast<std::size_t>(table), kTable);
  labels.insert(labels.end(), static_cast<std::size_t>(box), kBox);
  labels.insert(labels.end(), static_cast<std::size_t>(rest), kUnassigned);
  return labels;
}

TEST(SettleObjects, WhatIsLeftOfASegmentThatIsMostlyTheirsJoinsTheLargest) {
  Segmentation const result = settle_objects(row_of(pixels(5, 1, 4)));
  EXPECT_THAT(result.labels, ElementsAre(kTable, kTable, kTable, kTable, kTable, kBox, kTable,
                                         kTable, kTable, kTable));
  EXPECT_EQ(result.objects[0].pixel_count, 9U);
  EXPECT_EQ(result.objects[1].pixel_count, 1U);
}

TEST(SettleObjects, TheLittleThatTheyHoldOfASegmentGoesBack) {
  Segmentation const result = settle_objects(row_of(pixels(2, 0, 8)));
  EXPECT_THAT(result.labels, Each(kUnassigned));
  EXPECT_EQ(result.objects[0].pixel_count, 0U);
}

TEST(SettleObjects, AStripIsEnoughForTheRest) {
  Segmentation const result = settle_objects(row_of(pixels(3, 0, 7)));
  EXPECT_THAT(result.labels, Each(kTable));
}

TEST(SettleObjects, InBetweenNothingChanges) {
  Segmentation const before = row_of(pixels(5, 0, 15));
  EXPECT_EQ(settle_objects(before).labels, before.labels);
}

TEST(SettleObjects, WhatLiesOnASurfaceOfAnObjectIsNoneOfIt) {
  // Eight pixels of a table, and two of a pen that the table's region has taken.
  Segmentation before = row_of(pixels(10, 0, 0));
  before.segments.labels[8] = before.segments.labels[9] = 2;
  before.segments.pixel_counts = {8, 2};
  before.segments.lies_on = {0, 1};
  Segmentation const result = settle_objects(before);
  EXPECT_EQ(result.labels[8], kUnassigned);
  EXPECT_EQ(result.labels[9], kUnassigned);
  EXPECT_EQ(result.objects[0].pixel_count, 8U);
  // One that was told of keeps it.
  before.labels[8] = before.labels[9] = kBox;
  EXPECT_EQ(settle_objects(before).labels, before.labels);
  // So does one whose region has spilt over what it lies on.
  Segmentation spilt = row_of(pixels(0, 3, 7));
  spilt.segments.labels[0] = spilt.segments.labels[1] = 2;
  spilt.segments.pixel_counts = {8, 2};
  spilt.segments.lies_on = {0, 1};
  EXPECT_EQ(settle_objects(spilt).labels[0], kBox);
  EXPECT_EQ(settle_objects(spilt).labels[2], kUnassigned);
}

TEST(SettleObjects, WhatBelongsToNoSegmentAndWhatHasNoDepthStay) {
  Segmentation const none = row_of(pixels(9, 0, 1), 0);
  EXPECT_EQ(settle_objects(none).labels, none.labels);
  std::vector<LabelCode> labels = pixels(9, 0, 1);
  labels[9] = kNoDepth;
  EXPECT_EQ(settle_objects(row_of(labels)).labels[9], kNoDepth);
}

TEST(SettleObjects, WithoutSegmentsOrObjectsNothingHappens) {
  Segmentation before = row_of(pixels(8, 0, 2));
  before.segments = {};
  EXPECT_EQ(settle_objects(before).labels, before.labels);
  EXPECT_TRUE(settle_objects({}).labels.empty());
}

}  // namespace
}  // namespace credo::test
