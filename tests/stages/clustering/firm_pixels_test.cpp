#include "stages/clustering/firm_pixels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "stages/clustering/clustering.hpp"

namespace credo::test {
namespace {

using ::testing::Each;
using ::testing::SizeIs;

constexpr LabelCode kThing = kFirstStuff;

/// Of stuff the pixels of the piece that a pixel is in, with a minus where that is not firm. Runs
/// are in raster order, and each pixel of stuff is in one.
Grid<std::int64_t> pieces_px(Grid<float> const& depth_m, LabelMap const& labels) {
  Grid<std::int64_t> result(labels.width(), labels.height());
  std::size_t pixels = 0;
  std::size_t last_end = 0;
  for (StuffRun const& run : firm_runs(depth_m, labels)) {
    EXPECT_LE(last_end, run.pixels.begin);
    EXPECT_LT(run.pixels.begin, run.pixels.end);
    EXPECT_EQ(labels.pixel(run.pixels.begin).v, labels.pixel(run.pixels.end - 1).v);
    last_end = run.pixels.end;
    pixels += run.pixels.end - run.pixels.begin;
    for (std::size_t i = run.pixels.begin; i < run.pixels.end; ++i) {
      EXPECT_EQ(labels[i], run.label);
      auto const piece_px = static_cast<std::int64_t>(run.piece_px);
      result[i] = run.is_firm ? piece_px : -piece_px;
    }
  }
  EXPECT_EQ(pixels, static_cast<std::size_t>(std::ranges::count_if(labels, is_stuff)));
  return result;
}

/// Word for word: one piece after the other is filled, pixel by pixel.
Grid<std::int64_t> literal_pieces_px(Grid<float> const& depth_m, LabelMap const& labels) {
  constexpr std::array<Pixel, 4> kSteps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  Grid<std::uint8_t> taken(labels.width(), labels.height());
  std::vector<std::vector<Pixel>> pieces;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!is_stuff(labels[i]) || std::exchange(taken[i], 1) != 0) {
      continue;
    }
    std::vector<Pixel> piece = {labels.pixel(i)};
    for (std::size_t k = 0; k < piece.size(); ++k) {
      for (Pixel const step : kSteps) {
        Pixel const p = piece[k];
        Pixel const q{p.u + step.u, p.v + step.v};
        if (labels.contains(q) && taken[q] == 0 && labels[q] == labels[p] &&
            std::abs(depth_m[p] - depth_m[q]) < kFirm_per_m * (depth_m[p] * depth_m[q])) {
          taken[q] = 1;
          piece.push_back(q);
        }
      }
    }
    pieces.push_back(piece);
  }
  Grid<std::int64_t> result(labels.width(), labels.height());
  for (auto const& piece : pieces) {
    auto const piece_px = static_cast<std::int64_t>(piece.size());
    bool const is_firm = std::ranges::all_of(pieces, [&](auto const& other) {
      return labels[other[0]] != labels[piece[0]] || 10 * piece.size() >= other.size();
    });
    for (Pixel const p : piece) {
      result[p] = is_firm ? piece_px : -piece_px;
    }
  }
  return result;
}

/// Labels and depths of pieces from large ones with a few holes to crumbs.
void expect_literal(int width, int height, bool nan_without_depth, std::mt19937& random) {
  std::array<LabelCode, 6> const codes = {kThing, kThing,      kThing + 1,
                                          kFloor, kUnassigned, kNoDepth};
  LabelMap labels(width, height);
  Grid<float> depth_m(width, height);
  unsigned const noise = 1 + random() % 8;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    labels[i] = random() % 8 < noise ? codes.at(random() % codes.size())
                                     : codes.at(random() % 10 == 0 ? 2 : 0);
    depth_m[i] = labels[i] == kNoDepth   ? (nan_without_depth ? kNaN : 0.0F)
                 : random() % 16 < noise ? 1.0F + 0.01F * static_cast<float>(random() % 16)
                                         : 1.1F;
  }
  EXPECT_TRUE(pieces_px(depth_m, labels) == literal_pieces_px(depth_m, labels));
}

TEST(FirmPixels, AreThoseOfTheLiteralAlgorithm) {
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    SCOPED_TRACE(k);
    int const width = static_cast<int>(random() % 40);
    int const height = static_cast<int>(random() % 30);
    expect_literal(width, height, k % 2 != 0, random);
  }
}

// Rows that end with a word of bits, just before and just behind.
TEST(FirmPixels, AreThoseOfTheLiteralAlgorithmOnEveryInstructionSet) {
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    std::mt19937 random(2);
    for (int const width : {1, 17, 63, 64, 65, 66, 127, 128, 129, 192, 200}) {
      for (int k = 0; k < 6; ++k) {
        SCOPED_TRACE(width);
        expect_literal(width, 20, k % 2 != 0, random);
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(FirmPixels, AreThoseThatHoldTogether) {
  Grid<float> depth_m(8, 6, 1.0F);
  LabelMap const labels(8, 6, kThing);
  depth_m[{3, 2}] = 3.0F;
  depth_m[{4, 2}] = 3.0F;
  Grid<std::int64_t> const firm = pieces_px(depth_m, labels);
  for (std::size_t i = 0; i < firm.size(); ++i) {
    EXPECT_EQ(firm[i], depth_m[i] > 2.0F ? -2 : 46) << i;
  }
}

TEST(FirmPixels, BothHalvesOfAThingThatIsCutInTwoAreFirmAndFloorIsNoStuff) {
  LabelMap labels(9, 3, kThing);
  for (int v = 0; v < 3; ++v) {
    labels[{6, v}] = kFloor;
  }
  Grid<std::int64_t> const firm = pieces_px(Grid<float>(9, 3, 2.0F), labels);
  for (std::size_t i = 0; i < firm.size(); ++i) {
    EXPECT_EQ(firm[i] > 0, labels[i] == kThing);
  }
}

TEST(FirmPixels, ASlantedSurfaceIsFirmAsFarAsAKinectGoes) {
  Grid<float> depth_m(10, 6);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    depth_m[i] = 1.0F / (0.25F + 0.005F * static_cast<float>(depth_m.pixel(i).u));
  }
  EXPECT_THAT(pieces_px(depth_m, LabelMap(10, 6, kThing)), Each(60));
}

TEST(FirmPixels, WhatFallsApartAltogetherIsAllFirm) {
  Grid<float> depth_m(6, 6);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    depth_m[i] = 1.0F / (0.1F + 0.03F * static_cast<float>(i));
  }
  EXPECT_THAT(pieces_px(depth_m, LabelMap(6, 6, kThing)), Each(1));
}

// A bottle at 2 m with one pixel of the wall behind it.
TEST(FirmPixels, KeepABottlesBoundsToTheBottle) {
  Frame frame;
  Grid<float> depth_m(20, 20, 2.0F);
  depth_m[{0, 5}] = 5.0F;
  frame.cloud_camera = cloud_from_depth(depth_m, frame.intrinsics);
  Segmentation before = unassigned_segmentation(frame, Se3(), kPriorFrame);
  before.segments.labels = Grid<std::int32_t>(20, 20, 1);
  before.segments.pixel_counts = {400};
  Segmentation const result = cluster_stuff(frame, NormalMap(20, 20), before, {});
  ASSERT_THAT(result.stuff, SizeIs(1));
  EXPECT_EQ(result.stuff[0].pixel_count, 400U);
  EXPECT_LT(result.stuff[0].bounds_world.max().z(), 2.01F);
  EXPECT_NEAR(result.stuff[0].centroid_world.z(), 2.0F, 1e-3F);
  EXPECT_THAT(result.labels, Each(kThing));
}

}  // namespace
}  // namespace credo::test
