#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "stages/segments/depth_images.hpp"
#include "stages/segments/raised/raised_things.hpp"
#include "stages/segments/recorded_depths.hpp"
#include "stages/segments/table.hpp"
#include "support/literal_raised_things.hpp"

namespace credo {
namespace {

constexpr double kFocal_px = 525.0;

/// Finds more than the default does, and smaller things.
SegmentsConfig keen_config() {
  SegmentsConfig config;
  config.raised_quanta = 1.0;
  config.raised_min_pixels = 20;
  return config;
}

/// How many were found, with a config that finds many.
std::size_t expect_twin(Segments const& segments, Grid<float> const& depth_m) {
  std::size_t found = 0;
  struct Setting {
    double focal_px = kFocal_px;
    SegmentsConfig config;
  };
  for (auto const& [focal_px, config] :
       {Setting(), Setting{0.6 * kFocal_px, keen_config()}, Setting{.config = keen_config()}}) {
    Segments const fast = with_raised_things(segments, depth_m, focal_px, config);
    Segments const literal = test::literal_raised_things(segments, depth_m, focal_px, config);
    EXPECT_EQ(fast.pixel_counts, literal.pixel_counts);
    EXPECT_EQ(fast.lies_on, literal.lies_on);
    EXPECT_TRUE(fast.labels == literal.labels);
    found = fast.pixel_counts.size() - segments.pixel_counts.size();
  }
  return found;
}

std::size_t expect_twin(Grid<float> const& depth_m) {
  return expect_twin(convex_segments(depth_m, kFocal_px, {}), depth_m);
}

TEST(RaisedThingsTwin, Tables) {
  for (double const yaw_rad : {0.0, 0.3}) {
    test::Table table(0.9);
    table.add_box(-0.1, 0.0, yaw_rad, {0.1, 0.003, 0.14});
    table.add_box(0.15, 0.0, 0.7, {0.005, 0.0045, 0.07});
    EXPECT_GE(expect_twin(table.depth_m(false)), 1U);
    EXPECT_GE(expect_twin(table.depth_m(true)), 1U);
  }
}

TEST(RaisedThingsTwin, RandomPlanes) {
  std::size_t found = 0;
  for (unsigned const seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    SCOPED_TRACE(seed);
    found += expect_twin(test::random_planes(320, 240, seed));
  }
  EXPECT_GT(found, 0U);
}

// Waves and bumps of any size on one surface, in segments of any shape: pieces at every level that
// reach the image's border and other segments.
TEST(RaisedThingsTwin, BumpsOnSegmentsOfAnyShape) {
  std::size_t found = 0;
  for (unsigned const seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    int const width = 200 + static_cast<int>(seed) * 7;
    Segments segments;
    segments.labels = Grid<std::int32_t>(width, 160, 1);
    segments.pixel_counts.assign(2, 0);
    Grid<float> depth_m = test::depth_of_quanta(width, 160, [&](Pixel p) {
      double const bend = 1.5 * std::sin(p.u / 23.0) * std::sin(p.v / 31.0);
      bool const is_step = (p.u / 19 + p.v / 13) % 5 == 0;
      return 250.0 + 0.03 * p.u + bend + (is_step ? 3.0 * share(random) + 1.5 : 0.0) +
             share(random);
    });
    for (int hole = 0; hole < 40; ++hole) {
      Pixel const at{static_cast<int>(share(random) * width),
                     static_cast<int>(share(random) * 160)};
      auto const label = static_cast<std::int32_t>(share(random) * 3.0);
      for (int v = at.v; v < std::min(at.v + 6, 160); ++v) {
        for (int u = at.u; u < std::min(at.u + 9, width); ++u) {
          segments.labels[Pixel{u, v}] = label;
        }
      }
    }
    for (std::size_t i = 0; i < depth_m.size(); ++i) {
      if (segments.labels[i] == 0) {
        depth_m[i] = 0.0F;
      } else {
        ++segments.pixel_counts[static_cast<std::size_t>(segments.labels[i] - 1)];
      }
    }
    found += expect_twin(segments, depth_m);
  }
  EXPECT_GT(found, 20U);
}

TEST(RaisedThingsTwin, EveryInstructionSet) {
  test::Table table(0.9);
  table.add_box(-0.1, 0.0, 0.3, {0.1, 0.003, 0.14});
  Grid<float> const depth_m = table.depth_m(true);
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(expect_twin(depth_m), 1U);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(RaisedThingsTwin, NoiseAndSmallImages) {
  expect_twin(test::depth_noise(160, 120, 1));
  expect_twin(test::checkerboard(200, 150, 40));
  expect_twin(Grid<float>(1, 1, 1.0F));
  expect_twin(Grid<float>());
}

TEST(RaisedThingsTwin, TableTops) {
  CREDO_REQUIRE_RECORDING("osd");
  for (std::filesystem::path const& file : test::table_tops()) {
    SCOPED_TRACE(file.filename());
    expect_twin(test::table_top_depth_m(file));
  }
}

TEST(RaisedThingsTwin, Kitchen) {
  CREDO_REQUIRE_RECORDING("kitchen");
  for (std::string const number : {"000000", "000100", "000160", "000250", "000400"}) {
    SCOPED_TRACE(number);
    expect_twin(test::kitchen_depth_m(number));
  }
}

}  // namespace
}  // namespace credo
