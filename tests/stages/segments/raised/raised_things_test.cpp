#include "stages/segments/raised/raised_things.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "stages/segments/depth_images.hpp"
#include "stages/segments/table.hpp"

namespace credo {
namespace {

using Eigen::Vector3d;
using test::depth_of_quanta;
using test::kinect_intrinsics;
using test::label_at;
using test::Table;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Segments seen(Grid<float> const& depth_m) {
  return with_raised_things(convex_segments(depth_m, kinect_intrinsics().fx_px, {}), depth_m,
                            kinect_intrinsics().fx_px, {});
}

std::vector<std::int32_t> raised_in(Segments const& segments) {
  std::vector<std::int32_t> labels;
  for (std::size_t i = 0; i < segments.lies_on.size(); ++i) {
    if (segments.lies_on[i] != 0) {
      labels.push_back(static_cast<std::int32_t>(i + 1));
    }
  }
  return labels;
}

TEST(RaisedThings, AMagazineAndAPenOnATable) {
  for (bool const noisy : {false, true}) {
    Table table(1.0);
    table.add_box(-0.1, 0.0, 0.3, {0.1, 0.003, 0.14});
    table.add_box(0.15, 0.0, 0.7, {0.005, 0.0045, 0.07});
    Segments const segments = seen(table.depth_m(noisy));
    std::int32_t const top = label_at(segments, table.place(0.2, 0, 0.15));
    std::int32_t const magazine = label_at(segments, table.place(-0.1, 0.012, 0));
    std::int32_t const pen = label_at(segments, table.place(0.15, 0.009, 0));
    EXPECT_THAT(raised_in(segments), ::testing::UnorderedElementsAre(magazine, pen)) << noisy;
    EXPECT_EQ(segments.lies_on[static_cast<std::size_t>(magazine - 1)], top) << noisy;
    // 0.2 m by 0.28 m, seen at an angle of 0.6 to the table.
    double const expected_px =
        0.2 * 0.28 * std::sin(0.6) * std::pow(kinect_intrinsics().fx_px / 1.0, 2);
    EXPECT_NEAR(segments.pixel_counts[static_cast<std::size_t>(magazine - 1)], expected_px,
                0.2 * expected_px)
        << noisy;
  }
}

TEST(RaisedThings, ACableBeforeAWall) {
  Grid<float> const depth_m = depth_of_quanta(640, 480, [](Pixel p) {
    double const cable_u = 300 + 40 * std::sin(p.v / 60.0);
    return 250.0 + 0.02 * p.u + (std::abs(p.u - cable_u) < 2.5 ? 3.5 : 0.0);
  });
  Segments const segments = seen(depth_m);
  EXPECT_THAT(raised_in(segments), ElementsAre(2));
  EXPECT_NEAR(segments.pixel_counts[1], 5 * 480, 0.2 * 5 * 480);
}

TEST(RaisedThings, WhatASensorBendsHasNoEdge) {
  // Four quanta high, and 200 px wide.
  Grid<float> const depth_m = depth_of_quanta(640, 480, [](Pixel p) {
    double const u = (p.u - 320) / 80.0;
    double const v = (p.v - 240) / 80.0;
    return 250.0 + 4.0 * std::exp(-0.5 * (u * u + v * v));
  });
  EXPECT_THAT(raised_in(seen(depth_m)), IsEmpty());
}

/// On a plane, as high in its middle as told, sinking to nothing within so many pixels.
Grid<float> blurred_plate(double quanta, double blur_px) {
  return depth_of_quanta(640, 480, [=](Pixel p) {
    double const inside_px = std::min(50.0 - std::abs(p.u - 320), 40.0 - std::abs(p.v - 240));
    return 250.0 + quanta * std::clamp(inside_px / blur_px + 0.5, 0.0, 1.0);
  });
}

// A magazine seen from two metres away.
TEST(RaisedThings, ASensorBlursEdges) {
  EXPECT_THAT(raised_in(seen(blurred_plate(3.5, 10.0))), ElementsAre(2));
  Segments const segments = seen(blurred_plate(3.5, 10.0));
  EXPECT_NEAR(segments.pixel_counts[1], 100 * 80, 0.2 * 100 * 80);
  // Noise is as high as that, and has such slopes.
  EXPECT_THAT(raised_in(seen(blurred_plate(2.3, 10.0))), IsEmpty());
  // No edge is as wide as this.
  EXPECT_THAT(raised_in(seen(blurred_plate(3.5, 30.0))), IsEmpty());
}

// A lid has a rim, and a little beyond it; a thing may lie as near to the edge.
TEST(RaisedThings, ARimIsNone) {
  for (bool const is_rim : {true, false}) {
    Segments segments;
    segments.labels = Grid<std::int32_t>(640, 480, 1);
    segments.pixel_counts = {640 * 480 - 320 * 200, 320 * 200};
    Grid<float> const depth_m = depth_of_quanta(640, 480, [&](Pixel p) {
      if (p.u < 160 || p.u >= 480 || p.v < 140 || p.v >= 340) {
        return 250.0;
      }
      segments.labels[p] = 2;
      bool const is_raised = p.v > 315 && p.v < 334 && (is_rim || std::abs(p.u - 320) < 12);
      return is_raised ? 314.0 : 310.0;
    });
    Segments const result = with_raised_things(segments, depth_m, 525.0, {});
    EXPECT_EQ(raised_in(result).size(), is_rim ? 0U : 1U);
  }
}

// Between magazines side by side the surface may stand out as well, by more than the least level.
TEST(RaisedThings, WhatComesApartAtHalfItsHeightIsTwo) {
  auto const raised_with = [](int width_px) {
    Segments segments;
    segments.labels = Grid<std::int32_t>(640, 480, 1);
    segments.pixel_counts = {640 * 480};
    Grid<float> const depth_m = depth_of_quanta(640, 480, [&](Pixel p) {
      if (std::abs(p.v - 240) >= 30 || p.u < 200 || p.u >= 306 + width_px) {
        return 250.0;
      }
      return p.u >= 300 && p.u < 306 ? 251.2 : 253.0;
    });
    return raised_in(with_raised_things(std::move(segments), depth_m, 525.0, {}));
  };
  EXPECT_THAT(raised_with(100), ElementsAre(2, 3));
  EXPECT_THAT(raised_with(15), ElementsAre(2)) << "less than a fifth of it";
}

TEST(RaisedThings, OnABentSurfaceTheyAreFoundAllTheSame) {
  Grid<float> const depth_m = depth_of_quanta(640, 480, [](Pixel p) {
    double const u = (p.u - 320) / 80.0;
    double const v = (p.v - 240) / 80.0;
    bool const lies_there = std::abs(p.u - 330) < 40 && std::abs(p.v - 250) < 30;
    return 250.0 + 2.5 * std::exp(-0.5 * (u * u + v * v)) + (lies_there ? 2.6 : 0.0);
  });
  Segments const segments = seen(depth_m);
  EXPECT_THAT(raised_in(segments), ElementsAre(2));
  EXPECT_NEAR(segments.pixel_counts[1], 79 * 59, 0.2 * 79 * 59);
}

TEST(RaisedThings, TheFacesOfABoxAreNone) {
  for (double const yaw_rad : {0.0, 0.4, 0.8}) {
    Table table(0.6);
    table.add_box(0.0, 0.0, yaw_rad, {0.12, 0.08, 0.12});
    EXPECT_THAT(raised_in(seen(table.depth_m(true))), IsEmpty()) << yaw_rad;
  }
}

TEST(RaisedThings, WhatIsTooLowOrTooSmallIsNone) {
  for (auto const& [quanta, half_px] : {std::pair(1.2, 40), std::pair(6.0, 3)}) {
    Grid<float> const depth_m = depth_of_quanta(640, 480, [&, q = quanta, h = half_px](Pixel p) {
      return 250.0 + (std::abs(p.u - 300) < h && std::abs(p.v - 200) < h ? q : 0.0);
    });
    EXPECT_THAT(raised_in(seen(depth_m)), IsEmpty()) << quanta;
  }
}

TEST(RaisedThings, WhatIsAlongACreaseIsNone) {
  // A strip between a flat surface and another segment.
  Grid<float> const depth_m = depth_of_quanta(640, 480, [](Pixel p) {
    return p.u < 300 ? 250.0 : p.u < 308 ? 254.0 : 262.0;
  });
  Segments segments;
  segments.labels = Grid<std::int32_t>(640, 480, 1);
  for (std::size_t i = 0; i < segments.labels.size(); ++i) {
    segments.labels[i] = segments.labels.pixel(i).u < 308 ? 1 : 2;
  }
  segments.pixel_counts = {308 * 480, 332 * 480};
  Segments const result = with_raised_things(segments, depth_m, 525.0, {});
  EXPECT_THAT(raised_in(result), IsEmpty());
  EXPECT_EQ(result.labels, segments.labels);
}

TEST(RaisedThings, CountsAreThoseOfTheImage) {
  Table table(0.9);
  table.add_box(-0.1, 0.0, 0.3, {0.1, 0.006, 0.14});
  Segments const segments = seen(table.depth_m(true));
  std::vector<std::uint32_t> counts(segments.pixel_counts.size(), 0);
  for (std::int32_t const label : segments.labels) {
    if (label > 0) {
      ++counts[static_cast<std::size_t>(label - 1)];
    }
  }
  EXPECT_EQ(counts, segments.pixel_counts);
  EXPECT_EQ(segments.lies_on.size(), counts.size());
}

TEST(RaisedThings, NothingIsNoError) {
  EXPECT_THAT(raised_in(with_raised_things({}, {}, 525.0, {})), IsEmpty());
  for (auto const& [width, height] : {std::pair(1, 1), std::pair(1, 300), std::pair(300, 1)}) {
    for (float const depth_m : {0.0F, 1.0F}) {
      Segments const segments = seen(Grid<float>(width, height, depth_m));
      EXPECT_THAT(raised_in(segments), IsEmpty()) << width << "x" << height;
    }
  }
}

}  // namespace
}  // namespace credo
