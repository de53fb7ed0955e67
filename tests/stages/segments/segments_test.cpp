#include "stages/segments/segments.hpp"

#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>

#include "stages/segments/depth_images.hpp"
#include "stages/segments/table.hpp"
#include "support/rendered_scene.hpp"

namespace credo {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::kinect_intrinsics;
using test::label_at;
using test::Table;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kFocal_px = 525.0;

Segments segments_of(Grid<float> const& depth_m) {
  return convex_segments(depth_m, kFocal_px, {});
}

Segments segments_of(Table const& table, bool noisy) {
  return convex_segments(table.depth_m(noisy), kinect_intrinsics().fx_px, {});
}

/// Segments that are more than a splinter.
std::size_t large_count(Segments const& segments) {
  return static_cast<std::size_t>(
      std::ranges::count_if(segments.pixel_counts, [](std::uint32_t n) { return n > 300; }));
}

TEST(ConvexSegments, APlaneIsOneHoweverItLies) {
  for (double const down_rad : {0.0, 0.3, 0.8, 1.2}) {
    for (double const aside_rad : {-0.7, 0.0, 0.5}) {
      Vector3d const normal = AngleAxisd(aside_rad, Vector3d::UnitY()) *
                              (AngleAxisd(down_rad, Vector3d::UnitX()) * -Vector3d::UnitZ());
      test::Scene scene;
      scene.planes = {{normal, normal.dot(Vector3d(0, 0, 1.2))}};
      Grid<float> const depth_m = test::render(scene, 640, 480, kinect_intrinsics()).depth_m;
      Segments const clean = convex_segments(depth_m, kinect_intrinsics().fx_px, {});
      EXPECT_EQ(large_count(clean), 1U) << down_rad << " " << aside_rad;
      Segments const noisy =
          convex_segments(test::with_kinect_noise(depth_m, 5), kinect_intrinsics().fx_px, {});
      EXPECT_EQ(large_count(noisy), 1U) << down_rad << " " << aside_rad;
    }
  }
}

TEST(ConvexSegments, AThingAndItsTableAtEveryRange) {
  for (double const distance_m : {0.6, 0.9, 1.3, 1.8, 2.4, 3.0}) {
    for (double const yaw_rad : {0.0, 0.4, 0.8}) {
      for (bool const noisy : {false, true}) {
        if (noisy && distance_m > 2.5) {
          continue;  // the crease at its foot is no deeper than the noise
        }
        Table table(distance_m);
        table.add_box(0.0, 0.0, yaw_rad, {0.06, 0.08, 0.06});
        Segments const segments = segments_of(table, noisy);
        std::int32_t const top = label_at(segments, table.place(0, 0.16, 0));
        EXPECT_EQ(large_count(segments), 2U) << distance_m << " " << yaw_rad << " " << noisy;
        EXPECT_NE(top, label_at(segments, table.place(0.2, 0, 0)));
        // Its sides are one with its top.
        Vector3d const front = AngleAxisd(yaw_rad, Vector3d::UnitY()) * Vector3d(0, 0, -0.06);
        EXPECT_EQ(top, label_at(segments, table.place(front.x(), 0.08, front.z())));
      }
    }
  }
}

TEST(ConvexSegments, BoxesSideBySideAreTwo) {
  for (bool const noisy : {false, true}) {
    Table with_gap(0.9);
    with_gap.add_box(-0.08, 0.0, 0.0, {0.07, 0.07, 0.07});
    with_gap.add_box(0.08, 0.0, 0.0, {0.07, 0.07, 0.07});
    EXPECT_EQ(large_count(segments_of(with_gap, noisy)), 3U) << noisy;
    // They touch in an edge, and open towards the camera; one is higher.
    Table with_crease(0.9);
    with_crease.add_box(-0.09, 0.0, -0.5, {0.07, 0.07, 0.07});
    with_crease.add_box(0.09, 0.0, 0.5, {0.07, 0.10, 0.07});
    Segments const segments = segments_of(with_crease, noisy);
    EXPECT_EQ(large_count(segments), 3U) << noisy;
    EXPECT_NE(label_at(segments, with_crease.place(-0.09, 0.14, 0)),
              label_at(segments, with_crease.place(0.09, 0.20, 0)));
  }
}

TEST(ConvexSegments, ABoxBeforeAnotherIsAThingOfItsOwn) {
  Table table(1.0);
  table.add_box(0.0, 0.15, 0.0, {0.12, 0.12, 0.04});
  table.add_box(0.02, -0.06, 0.3, {0.05, 0.06, 0.05});
  table.add_ball(-0.25, 0.0, 0.06);
  Segments const segments = segments_of(table, true);
  EXPECT_EQ(large_count(segments), 4U);
}

TEST(ConvexSegments, ABoxOnABoxIsTwo) {
  Table table(1.0);
  table.add_box(0.0, 0.0, 0.2, {0.12, 0.05, 0.12});
  Segments const one = segments_of(table, true);
  EXPECT_EQ(large_count(one), 2U);
  // A smaller one on its top: as if it stood on the table, twice as high.
  table.add_box(0.0, 0.0, 0.2, {0.06, 0.10, 0.06});
  Segments const two = segments_of(table, true);
  EXPECT_EQ(large_count(two), 3U);
}

TEST(ConvexSegments, AConvexEdgeNeverSplits) {
  for (double const slope : {0.2, 0.5, 1.0, 1.6}) {
    Segments const roof = segments_of(test::depth_of_quanta(
        200, 150, [&](Pixel p) { return 400.0 - slope * std::abs(p.u - 100); }));
    EXPECT_THAT(roof.pixel_counts, ElementsAre(200 * 150)) << slope;
  }
}

TEST(ConvexSegments, AConcaveEdgeSplitsWhereItIs) {
  for (double const slope : {0.6, 1.0, 1.6}) {
    Segments const valley = segments_of(test::depth_of_quanta(
        200, 150, [&](Pixel p) { return 200.0 + slope * std::abs(p.u - 100); }));
    ASSERT_THAT(valley.pixel_counts, SizeIs(2)) << slope;
    EXPECT_NEAR(valley.pixel_counts[0], 100 * 150, 150);
  }
}

TEST(ConvexSegments, AJumpSplits) {
  Segments const step = segments_of(
      test::depth_of_quanta(200, 150, [](Pixel p) { return p.u < 120 ? 300.0 : 312.0; }));
  EXPECT_THAT(step.pixel_counts, ElementsAre(120 * 150, 80 * 150));
  EXPECT_EQ((step.labels[{119, 70}]), 1);
  EXPECT_EQ((step.labels[{120, 70}]), 2);
}

/// Numbers that a partition must keep in any frame.
void expect_sound(Grid<float> const& depth_m, Segments const& segments) {
  ASSERT_TRUE(segments.labels.same_size(depth_m));
  std::vector<std::uint32_t> counts;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    auto const label = static_cast<std::size_t>(segments.labels[i]);
    ASSERT_LE(label, counts.size() + 1) << "labels are numbered by their first pixels";
    counts.resize(std::max(counts.size(), label));
    if (label > 0) {
      ++counts[label - 1];
      ASSERT_TRUE(depth_m[i] > 0.0F && std::isfinite(depth_m[i]));
    }
  }
  EXPECT_EQ(counts, segments.pixel_counts);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    Pixel const p = depth_m.pixel(i);
    for (Pixel const q : {Pixel{p.u + 1, p.v}, Pixel{p.u, p.v + 1}}) {
      if (depth_m.contains(q) && depth_m[p] > 0.0F && depth_m[q] > 0.0F) {
        ASSERT_EQ(segments.labels[p] == 0, segments.labels[q] == 0) << "labels leave nothing over";
      }
    }
  }
}

TEST(ConvexSegments, AreAPartition) {
  Grid<float> const room = test::with_kinect_noise(
      test::render(test::room_scene(), 640, 480, kinect_intrinsics()).depth_m, 2);
  expect_sound(room, convex_segments(room, kinect_intrinsics().fx_px, {}));
  for (unsigned seed = 20; seed < 26; ++seed) {
    Grid<float> const planes = test::random_planes(230, 170, seed);
    expect_sound(planes, segments_of(planes));
  }
  Grid<float> const noise = test::depth_noise(230, 170, 1);
  expect_sound(noise, segments_of(noise));
}

TEST(ConvexSegments, AreTheSameToTheByteOnEveryInstructionSet) {
  Grid<float> const room = test::with_kinect_noise(
      test::render(test::room_scene(), 640, 480, kinect_intrinsics()).depth_m, 2);
  Segments const best = convex_segments(room, kinect_intrinsics().fx_px, {});
  EXPECT_TRUE(convex_segments(room, kinect_intrinsics().fx_px, {}).labels == best.labels);
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    Segments const again = convex_segments(room, kinect_intrinsics().fx_px, {});
    EXPECT_TRUE(again.labels == best.labels) << hwy::TargetName(target);
    EXPECT_EQ(again.pixel_counts, best.pixel_counts);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(ConvexSegments, AMirroredFrameComesApartInTheSamePieces) {
  Grid<float> const room = test::with_kinect_noise(
      test::render(test::room_scene(), 640, 480, kinect_intrinsics()).depth_m, 2);
  Segments const there = convex_segments(room, kinect_intrinsics().fx_px, {});
  Segments const mirrored = convex_segments(test::mirrored(room), kinect_intrinsics().fx_px, {});
  Grid<std::int32_t> const back = test::mirrored(mirrored.labels);
  // Each segment's pixels, by the label that most of them have in the other.
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> common;
  for (std::size_t i = 0; i < back.size(); ++i) {
    ++common[{there.labels[i], back[i]}];
  }
  std::map<std::int32_t, std::uint32_t> most;
  for (auto const& [pair, pixels] : common) {
    most[pair.first] = std::max(most[pair.first], pixels);
  }
  std::uint32_t same = 0;
  for (auto const& [label, pixels] : most) {
    same += pixels;
  }
  EXPECT_GT(same, 0.99 * static_cast<double>(back.size()));
  EXPECT_EQ(large_count(there), large_count(mirrored));
}

TEST(ConvexSegments, WithoutDepthThereAreNone) {
  EXPECT_THAT(segments_of(Grid<float>()).pixel_counts, IsEmpty());
  EXPECT_TRUE(segments_of(Grid<float>(0, 7)).labels.same_size(Grid<int>(0, 7)));
  EXPECT_TRUE(segments_of(Grid<float>(7, 0)).labels.same_size(Grid<int>(7, 0)));
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (float const z : {0.0F, -1.0F, kInfinity, -kInfinity, kNaN, 2e4F}) {
    Segments const none = segments_of(Grid<float>(100, 80, z));
    EXPECT_THAT(none.pixel_counts, IsEmpty()) << z;
    EXPECT_THAT(none.labels, Each(0)) << z;
  }
}

TEST(ConvexSegments, AFlatFrameIsOneAtAnyRange) {
  for (float const z : {std::numeric_limits<float>::denorm_min(), 0.01F, 0.17F, 1.0F, 100.0F}) {
    EXPECT_THAT(segments_of(Grid<float>(100, 80, z)).pixel_counts, ElementsAre(8000)) << z;
  }
}

TEST(ConvexSegments, WhatIsTooNearToTellIsFlat) {
  Grid<float> depth_m(100, 80, 0.02F);
  std::fill_n(depth_m.begin(), 4000, 0.15F);
  EXPECT_THAT(segments_of(depth_m).pixel_counts, ElementsAre(8000));
}

TEST(ConvexSegments, TooFewPixelsAreNone) {
  // Fewer than min_pixels, and nowhere nine pixels wide.
  EXPECT_THAT(segments_of(Grid<float>(1, 1, 1.0F)).labels, Each(0));
  EXPECT_THAT(segments_of(Grid<float>(79, 1, 1.0F)).labels, Each(0));
  EXPECT_THAT(segments_of(Grid<float>(80, 1, 1.0F)).labels, Each(1));
  EXPECT_THAT(segments_of(Grid<float>(1, 80, 1.0F)).labels, Each(1));
  EXPECT_THAT(segments_of(Grid<float>(7, 7, 1.0F)).labels, Each(0));
  EXPECT_THAT(segments_of(Grid<float>(8, 8, 1.0F)).labels, Each(1)) << "a thick core is enough";
}

TEST(ConvexSegments, NoiseAndFineCheckersAreNone) {
  EXPECT_THAT(segments_of(test::depth_noise(120, 90, 2)).labels, Each(0));
  EXPECT_THAT(segments_of(test::checkerboard(120, 90, 1)).labels, Each(0));
  // Cells that are thick enough are a part each.
  EXPECT_THAT(segments_of(test::checkerboard(120, 90, 15)).pixel_counts, SizeIs(48));
}

}  // namespace
}  // namespace credo
