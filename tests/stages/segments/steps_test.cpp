// Each step on images whose answer is plain.
#include <gmock/gmock.h>

#include <cstdlib>
#include <set>

#include "stages/segments/convexity/labels.hpp"
#include "stages/segments/convexity/limits.hpp"
#include "stages/segments/convexity/region_graph.hpp"
#include "stages/segments/convexity/region_merge.hpp"
#include "stages/segments/convexity/surface_map.hpp"
#include "stages/segments/depth_images.hpp"

namespace credo::segments {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr int kWidth = 80;
constexpr int kHeight = 60;
constexpr int kMiddle = 40;

Limits limits() {
  return limits_for(525.0, {});
}

SurfaceMap map_of(std::function<double(Pixel)> const& quanta) {
  return map_surfaces(test::depth_of_quanta(kWidth, kHeight, quanta), limits());
}

double wall(Pixel) {
  return 300.0;
}
double valley(Pixel p) {
  return 300.0 + std::abs(p.u - kMiddle);
}
double ridge(Pixel p) {
  return 300.0 - std::abs(p.u - kMiddle);
}
double step(Pixel p) {
  return p.u < kMiddle ? 300.0 : 320.0;
}

/// One label on each side of a column.
PartLabels halves(int column) {
  PartLabels labels(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    std::fill_n(labels.row(v), column, 1);
    std::fill_n(labels.row(v) + column, kWidth - column, 2);
  }
  return labels;
}

std::set<std::int32_t> labels_in(PartLabels const& labels, int begin_u, int end_u) {
  std::set<std::int32_t> found;
  for (int v = 0; v < labels.height(); ++v) {
    found.insert(labels.row(v) + begin_u, labels.row(v) + end_u);
  }
  return found;
}

TEST(MapSurfaces, AWallIsThickestInside) {
  SurfaceMap const map = map_of(wall);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      ASSERT_EQ(map.disparity.row(v)[u], 300 * kUnitsPerQuantum);
      ASSERT_EQ(map.concavity.row(v)[u], 0);
      ASSERT_EQ(map.wall.row(v)[u], 0);
      int const inside = std::min({u, v, kWidth - 1 - u, kHeight - 1 - v});
      ASSERT_EQ(map.thickness.row(v)[u], std::min(4, inside + 1));
    }
  }
}

TEST(MapSurfaces, AConcaveEdgeIsACrease) {
  SurfaceMap const map = map_of(valley);
  // Twelve pixels to both sides it is twelve quanta higher, and smoothing has raised the bottom by
  // 1.2; over six pixels it would be less.
  EXPECT_NEAR(map.concavity.row(30)[kMiddle], 0.65 * 2 * (12.0 - 1.2) * kUnitsPerQuantum, 2.0);
  EXPECT_EQ(map.wall.row(30)[kMiddle], 1);
  EXPECT_EQ(map.thickness.row(30)[kMiddle], 0);
  EXPECT_EQ(map.wall.row(30)[kMiddle - 10], 0);
  EXPECT_EQ(map.thickness.row(30)[kMiddle - 12], 4);
}

TEST(MapSurfaces, AConvexEdgeIsNoCrease) {
  SurfaceMap const map = map_of(ridge);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      ASSERT_EQ(map.wall.row(v)[u], 0) << u << " " << v;
    }
  }
  EXPECT_EQ(map.thickness.row(30)[kMiddle], 4);
}

TEST(MapSurfaces, BothEndsOfAJumpAreThin) {
  SurfaceMap const map = map_of(step);
  EXPECT_EQ(map.thickness.row(30)[kMiddle - 2], 1);
  EXPECT_EQ(map.thickness.row(30)[kMiddle - 1], 0);
  EXPECT_EQ(map.thickness.row(30)[kMiddle], 0);
  EXPECT_EQ(map.thickness.row(30)[kMiddle + 1], 1);
  EXPECT_EQ(map.concavity.row(30)[kMiddle], 0) << "not one surface";
}

TEST(MapSurfaces, ACreaseMustExceedTheNoiseOfTheFrame) {
  // A valley beside others as deep: half of the frame is concave, a quarter by six quanta.
  Grid<float> const depth_m = test::depth_of_quanta(
      kWidth, kHeight, [](Pixel p) { return 300.0 + std::abs(p.u % 12 - 6); });
  SegmentsConfig config;
  config.crease_noise = 0.0;
  EXPECT_EQ(map_surfaces(depth_m, limits_for(525.0, config)).wall.row(30)[18], 1);
  config.crease_noise = 3.0;
  EXPECT_EQ(map_surfaces(depth_m, limits_for(525.0, config)).wall.row(30)[18], 0);
}

TEST(GrowParts, MeetAtACreaseAndAtAJump) {
  for (auto const& scene : {valley, step}) {
    PartLabels const labels = grow_parts(map_of(scene), limits());
    EXPECT_THAT(labels_in(labels, 0, kMiddle - 2), ElementsAre(1));
    EXPECT_THAT(labels_in(labels, kMiddle + 2, kWidth), ElementsAre(2));
    EXPECT_THAT(labels_in(labels, 0, kWidth), ElementsAre(1, 2)) << "nothing is left over";
  }
}

TEST(GrowParts, AreOneAcrossAConvexEdge) {
  EXPECT_THAT(labels_in(grow_parts(map_of(ridge), limits()), 0, kWidth), ElementsAre(1));
}

TEST(GrowParts, DoNotLeakThroughAGap) {
  // For four rows the step is missing.
  PartLabels const labels =
      grow_parts(map_of([](Pixel p) { return p.v >= 28 && p.v < 32 ? 300.0 : step(p); }), limits());
  EXPECT_EQ(labels.row(10)[20], 1);
  EXPECT_EQ(labels.row(10)[60], 2);
  EXPECT_EQ(labels.row(50)[20], labels.row(10)[20]);
}

TEST(GrowParts, SmallIslandsHaveNone) {
  // Amid pixels without depth 7x8, and 8x8: of those four are thick.
  PartLabels const labels = grow_parts(map_of([](Pixel p) {
                                         bool const is_island =
                                             p.v >= 10 && p.v < 18 &&
                                             ((p.u >= 10 && p.u < 17) || (p.u >= 50 && p.u < 58));
                                         return is_island ? 300.0 : 0.0;
                                       }),
                                       limits());
  EXPECT_EQ(labels.row(14)[13], 0);
  EXPECT_EQ(labels.row(14)[53], 1);
  EXPECT_EQ(labels.row(10)[50], 1);
  EXPECT_EQ(labels.row(30)[30], 0);
}

TEST(RegionGraphOf, OneSurfaceGoesOn) {
  RegionGraph const graph = region_graph(
      map_of([](Pixel p) { return 300.0 + 0.5 * p.u - 0.25 * p.v; }), halves(kMiddle), limits());
  ASSERT_THAT(graph.borders, SizeIs(1));
  Border const& border = graph.borders[0];
  EXPECT_EQ(border.low, 1);
  EXPECT_EQ(border.high, 2);
  EXPECT_EQ(border.pairs, 60U);
  EXPECT_EQ(border.parted, 0U);
  EXPECT_EQ(border.samples, 20U) << "every third";
  EXPECT_EQ(border.unlike, 0U);
  EXPECT_THAT(graph.sizes, ElementsAre(0, 2400, 2400));
  ASSERT_THAT(graph.samples, SizeIs(20));
  for (BorderSample const& sample : graph.samples) {
    EXPECT_EQ(sample.beside, sample.at + 1);
    EXPECT_NEAR(sample.plane.per_u, 0.5, 0.03);
    EXPECT_NEAR(sample.plane_beside.per_v, -0.25, 0.03);
    EXPECT_LT(sample.plane.rms_quanta, 0.5);
  }
}

TEST(RegionGraphOf, AConcaveEdgeAndAStepDoNotGoOn) {
  for (auto const& scene : {valley, step}) {
    RegionGraph const graph = region_graph(map_of(scene), halves(kMiddle), limits());
    ASSERT_THAT(graph.borders, SizeIs(1));
    EXPECT_EQ(graph.borders[0].parted, 60U);
    EXPECT_EQ(graph.borders[0].unlike, graph.borders[0].samples);
    EXPECT_EQ(graph.borders[0].samples, 20U);
  }
}

TEST(RegionGraphOf, AConvexEdgeGoesOn) {
  RegionGraph const graph = region_graph(map_of(ridge), halves(kMiddle), limits());
  ASSERT_THAT(graph.borders, SizeIs(1));
  EXPECT_EQ(graph.borders[0].parted, 0U);
  EXPECT_EQ(graph.borders[0].unlike, 0U);
}

TEST(RegionGraphOf, AFewPixelsHaveNoPlane) {
  RegionGraph const graph = region_graph(map_of(wall), halves(1), limits());
  ASSERT_THAT(graph.borders, SizeIs(1));
  EXPECT_EQ(graph.borders[0].pairs, 60U);
  EXPECT_EQ(graph.borders[0].samples, 0U) << "a column is too thin";
}

RegionGraph graph_of(std::vector<Border> borders, std::vector<std::uint32_t> sizes) {
  RegionGraph graph;
  graph.borders = std::move(borders);
  graph.sizes = std::move(sizes);
  return graph;
}

TEST(JoinedParts, WhatNothingHoldsApart) {
  RegionGraph graph =
      graph_of({{1, 2, 100, 0, 30, 0}, {2, 3, 100, 100, 30, 30}}, {0, 2000, 3000, 4000});
  EXPECT_THAT(joined_parts(graph, limits()), ElementsAre(0, 1, 1, 3));
  EXPECT_EQ(graph.sizes[1], 5000U);
  EXPECT_EQ(graph.sizes[3], 4000U);
}

TEST(JoinedParts, SamplesCountMoreThanCreases) {
  // 0.3 of the share parted, 0.7 of the share unlike.
  RegionGraph parted = graph_of({{1, 2, 100, 100, 30, 5}}, {0, 2000, 2000});
  EXPECT_THAT(joined_parts(parted, limits()), ElementsAre(0, 1, 1));
  RegionGraph unlike = graph_of({{1, 2, 100, 0, 30, 22}}, {0, 2000, 2000});
  EXPECT_THAT(joined_parts(unlike, limits()), ElementsAre(0, 1, 2));
  RegionGraph small = graph_of({{1, 2, 100, 0, 30, 22}}, {0, 999, 2000});
  EXPECT_THAT(joined_parts(small, limits()), ElementsAre(0, 1, 1)) << "small ones join easily";
  RegionGraph without_samples = graph_of({{1, 2, 100, 49, 0, 0}}, {0, 2000, 2000});
  EXPECT_THAT(joined_parts(without_samples, limits()), ElementsAre(0, 1, 1));
}

TEST(JoinedParts, NeverOverAFewPixels) {
  RegionGraph graph = graph_of({{1, 2, 7, 0, 0, 0}, {1, 3, 8, 0, 0, 0}}, {0, 2000, 2000, 2000});
  EXPECT_THAT(joined_parts(graph, limits()), ElementsAre(0, 1, 2, 1));
}

TEST(JoinedParts, BordersOfWhatJoinedAddUp) {
  // 3 joins 2 first; what is then between 1 and {2, 3} is weak as a whole, though 1 3 is not.
  RegionGraph graph = graph_of({{1, 2, 80, 0, 20, 4}, {1, 3, 20, 20, 6, 6}, {2, 3, 50, 0, 15, 0}},
                               {0, 2000, 2000, 2000});
  EXPECT_THAT(joined_parts(graph, limits()), ElementsAre(0, 1, 1, 1));
  // And strong as a whole, though 1 2 is weak.
  graph = graph_of({{1, 2, 20, 0, 6, 2}, {1, 3, 80, 80, 20, 20}, {2, 3, 50, 0, 15, 0}},
                   {0, 2000, 2000, 2000});
  EXPECT_THAT(joined_parts(graph, limits()), ElementsAre(0, 1, 2, 2));
}

TEST(JoinedParts, OneThatGrewIsNoLongerSmall) {
  // Apart from its size the border 1 3 is too strong; 1 was small before it joined 2.
  RegionGraph graph =
      graph_of({{1, 2, 100, 0, 30, 0}, {1, 3, 100, 0, 30, 22}}, {0, 600, 600, 2000});
  EXPECT_THAT(joined_parts(graph, limits()), ElementsAre(0, 1, 1, 3));
}

TEST(SharpenBorders, MovesABorderToItsStep) {
  SurfaceMap const map = map_of(step);
  PartLabels labels = halves(kMiddle + 1);
  RegionGraph const graph = region_graph(map, labels, limits());
  sharpen_borders(map, graph, {0, 1, 2}, limits(), labels);
  // There is a sample in each third row, up to the last but two.
  for (int v = 0; v + 1 < kHeight; ++v) {
    EXPECT_EQ(labels.row(v)[kMiddle - 1], 1);
    EXPECT_EQ(labels.row(v)[kMiddle], 2) << v;
  }
}

TEST(SharpenBorders, TakesJoinedPartsAsOne) {
  SurfaceMap const map = map_of(step);
  PartLabels labels = halves(kMiddle + 1);
  RegionGraph const graph = region_graph(map, labels, limits());
  sharpen_borders(map, graph, {0, 1, 1}, limits(), labels);
  EXPECT_EQ(labels.row(30)[kMiddle], 1);
}

TEST(SharpenBorders, LeavesSmallPartsAndSmoothSurfaces) {
  SurfaceMap const map = map_of(step);
  PartLabels labels = halves(kMiddle + 1);
  RegionGraph graph = region_graph(map, labels, limits());
  graph.sizes[2] = 399;
  sharpen_borders(map, graph, {0, 1, 2}, limits(), labels);
  EXPECT_EQ(labels.row(30)[kMiddle], 1);
  SurfaceMap const smooth = map_of(wall);
  sharpen_borders(smooth, region_graph(smooth, labels, limits()), {0, 1, 2}, limits(), labels);
  EXPECT_EQ(labels.row(30)[kMiddle], 1);
}

}  // namespace
}  // namespace credo::segments
