#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/evaluation.hpp"
#include "io/pcd.hpp"
#include "stages/segments/recorded_depths.hpp"
#include "stages/segments/segments.hpp"
#include "stages/segments/things.hpp"
#include "support/literal_convexity.hpp"

namespace credo {
namespace {

void expect_twin(Grid<float> const& depth_m, double focal_px) {
  Segments const fast = convex_segments(depth_m, focal_px, {});
  Segments const literal = test::literal_convex_segments(depth_m, focal_px, {});
  EXPECT_GT(fast.pixel_counts.size(), 1U);
  EXPECT_EQ(fast.pixel_counts, literal.pixel_counts);
  EXPECT_TRUE(fast.labels == literal.labels);
}

TEST(SegmentsOfRecordings, TableTopsAreTheLiteralAlgorithm) {
  CREDO_REQUIRE_RECORDING("osd");
  auto const files = test::table_tops();
  EXPECT_FALSE(files.empty());
  for (std::filesystem::path const& file : files) {
    SCOPED_TRACE(file.filename());
    expect_twin(test::table_top_depth_m(file), test::kTableTopFocal_px);
  }
}

TEST(SegmentsOfRecordings, KitchenIsTheLiteralAlgorithm) {
  CREDO_REQUIRE_RECORDING("kitchen");
  for (std::string const number : {"000000", "000100", "000250", "000400"}) {
    SCOPED_TRACE(number);
    expect_twin(test::kitchen_depth_m(number), test::kKitchenFocal_px);
  }
}

Scores table_top_scores(bool whole_things) {
  LabelEvaluation evaluation;
  for (std::filesystem::path const& file : test::table_tops()) {
    Grid<float> const depth_m = test::table_top_depth_m(file);
    SegmentsConfig config;
    config.join_parts = whole_things;
    config.raised_quanta = whole_things ? config.raised_quanta : 0.0;
    Segments const segments = segment_things(
        depth_m, {}, {test::kTableTopFocal_px, test::kTableTopFocal_px}, std::nullopt, config);
    LabelMap labels(segments.labels.width(), segments.labels.height(), kUnassigned);
    std::ranges::transform(segments.labels, labels.begin(), [](std::int32_t label) {
      return label == 0 ? kUnassigned : static_cast<LabelCode>(kFirstStuff + label - 1);
    });
    evaluation.add(labels, read_pcd_labels(file).value());
  }
  return evaluation.scores();
}

TEST(SegmentsOfRecordings, TableTopsComeApartAsPeopleTookThemApart) {
  CREDO_REQUIRE_RECORDING("osd");
  OverlapScores const parts = table_top_scores(false).segmentation.instances.value();
  EXPECT_GE(parts.weighted_overlap, 0.975);
  EXPECT_LE(parts.over_segmentation, 0.02);
  EXPECT_LE(parts.under_segmentation, 0.03);
  EXPECT_GE(parts.recall_50, 0.975);
}

TEST(SegmentsOfRecordings, ThingsOnTableTopsAreWhole) {
  CREDO_REQUIRE_RECORDING("osd");
  OverlapScores const things = table_top_scores(true).segmentation.merged.value();
  EXPECT_GE(things.weighted_overlap, 0.95);
  EXPECT_LE(things.under_segmentation, 0.03);
  EXPECT_GE(things.recall_50, 0.99);
}

}  // namespace
}  // namespace credo
