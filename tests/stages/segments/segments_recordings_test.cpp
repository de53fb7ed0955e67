#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/evaluation.hpp"
#include "io/image.hpp"
#include "io/pcd.hpp"
#include "stages/segments/segments.hpp"
#include "stages/segments/things.hpp"
#include "support/literal_convexity.hpp"
#include "support/recordings.hpp"

namespace credo {
namespace {

constexpr double kFarthest_m = 10.0;
constexpr double kTableTopFocal_px = 525.0;
constexpr double kKitchenFocal_px = 585.0;

void expect_twin(Grid<float> const& depth_m, double focal_px) {
  Segments const fast = convex_segments(depth_m, focal_px, {});
  Segments const literal = test::literal_convex_segments(depth_m, focal_px, {});
  EXPECT_GT(fast.pixel_counts.size(), 1U);
  EXPECT_EQ(fast.pixel_counts, literal.pixel_counts);
  EXPECT_TRUE(fast.labels == literal.labels);
}

std::vector<std::filesystem::path> table_tops() {
  std::vector<std::filesystem::path> files;
  for (auto const& entry : std::filesystem::directory_iterator(test::recordings() / "osd")) {
    if (entry.path().extension() == ".pcd") {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

TEST(SegmentsOfRecordings, TableTopsAreTheLiteralAlgorithm) {
  CREDO_REQUIRE_RECORDING("osd");
  auto const files = table_tops();
  EXPECT_FALSE(files.empty());
  for (std::filesystem::path const& file : files) {
    SCOPED_TRACE(file.filename());
    expect_twin(read_pcd(file, CloudAxes::kOptical, kFarthest_m).cloud_camera.z, kTableTopFocal_px);
  }
}

TEST(SegmentsOfRecordings, KitchenIsTheLiteralAlgorithm) {
  CREDO_REQUIRE_RECORDING("kitchen");
  for (std::string const number : {"000000", "000100", "000250", "000400"}) {
    SCOPED_TRACE(number);
    Grid<std::uint16_t> const counts =
        read_png16(test::recordings() / "kitchen" / ("frame-" + number + ".depth.png"));
    Grid<float> depth_m(counts.width(), counts.height());
    std::ranges::transform(counts, depth_m.begin(), [](std::uint16_t mm) {
      return mm == 65535 ? 0.0F : static_cast<float>(mm) * 0.001F;
    });
    expect_twin(depth_m, kKitchenFocal_px);
  }
}

Scores table_top_scores(bool whole_things) {
  LabelEvaluation evaluation;
  for (std::filesystem::path const& file : table_tops()) {
    Grid<float> const depth_m = read_pcd(file, CloudAxes::kOptical, kFarthest_m).cloud_camera.z;
    SegmentsConfig config;
    config.join_parts = whole_things;
    config.raised_quanta = whole_things ? config.raised_quanta : 0.0;
    Segments const segments =
        segment_things(depth_m, {kTableTopFocal_px, kTableTopFocal_px}, std::nullopt, config);
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
