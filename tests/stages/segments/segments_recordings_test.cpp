#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "eval/evaluation.hpp"
#include "io/image.hpp"
#include "io/pcd.hpp"
#include "stages/segments/segments.hpp"
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

TEST(SegmentsOfRecordings, TableTopsComeApartAsPeopleTookThemApart) {
  CREDO_REQUIRE_RECORDING("osd");
  LabelEvaluation evaluation;
  for (std::filesystem::path const& file : table_tops()) {
    Segments const segments = convex_segments(
        read_pcd(file, CloudAxes::kOptical, kFarthest_m).cloud_camera.z, kTableTopFocal_px, {});
    LabelMap labels(segments.labels.width(), segments.labels.height(), kUnassigned);
    std::ranges::transform(segments.labels, labels.begin(), [](std::int32_t label) {
      return label == 0 ? kUnassigned : static_cast<LabelCode>(kFirstStuff + label - 1);
    });
    auto const true_labels = read_pcd_labels(file);
    ASSERT_TRUE(true_labels);
    evaluation.add(labels, *true_labels);
  }
  Scores const scores = evaluation.scores();
  ASSERT_TRUE(scores.segmentation.instances);
  OverlapScores const parts = *scores.segmentation.instances;
  EXPECT_GE(parts.weighted_overlap, 0.975);
  EXPECT_LE(parts.over_segmentation, 0.02);
  EXPECT_LE(parts.under_segmentation, 0.03);
  EXPECT_GE(parts.recall_50, 0.975);
  ASSERT_TRUE(scores.segmentation.merged);
  EXPECT_GE(scores.segmentation.merged->weighted_overlap, 0.92);
}

}  // namespace
}  // namespace credo
