#include <gtest/gtest.h>

#include <optional>

#include "stages/segments/parts/thing_parts.hpp"
#include "stages/segments/schematic.hpp"

// Rims: where insides and outsides meet, and what is around level surfaces.
namespace credo {
namespace {

using Eigen::Vector3d;
using test::front;
using test::hollow_inside;
using test::Schematic;
using test::vessel;

// A mug's inside goes on in its outside at both ends of what the rim hides.
TEST(JoinParts, AnInsideThatGoesOnInItsOutsideIsLessHollow) {
  auto const mug = [](double behind_m, double bend_quanta, Pixel table_first, Pixel table_last,
                      int front_rows = 30) {
    Schematic picture = vessel(
        [&](Pixel p) {
          double const from_middle = (p.u - 99.5) / 40.0;
          return 1.0 / (1.0 / behind_m + bend_quanta * 0.00287 * from_middle * from_middle);
        },
        front_rows);
    for (Pixel const end : {Pixel{60, 70}, Pixel{124, 70}}) {
      picture.add_depth(end, {end.u + 16, 72}, [&](Pixel) { return behind_m; });
    }
    picture.add_depth(table_first, table_last, [&](Pixel) { return behind_m; });
    return picture.joins(std::nullopt);
  };
  EXPECT_TRUE(mug(1.1, 3, {0, 0}, {0, 0}));
  EXPECT_FALSE(mug(1.1, 1.5, {0, 0}, {0, 0})) << "flat";
  EXPECT_FALSE(mug(1.01, 3, {0, 0}, {0, 0})) << "the front hides nothing of it";
  EXPECT_TRUE(mug(1.1, 3, {60, 40}, {80, 50})) << "touches what is beyond by little";
  EXPECT_FALSE(mug(1.1, 3, {60, 40}, {110, 50})) << "and by more";
  EXPECT_FALSE(mug(1.1, 3, {0, 0}, {0, 0}, 4)) << "more than four times its front";
  EXPECT_FALSE(vessel([](Pixel p) {
                 double const from_middle = (p.u - 99.5) / 40.0;
                 return 1.0 / (1.0 / 1.1 + 3 * 0.00287 * from_middle * from_middle);
               }).joins(std::nullopt))
      << "behind all of its front";
}

TEST(JoinParts, AnInsideThatGoesOnInItsOutsideIsNotCutOffBesideIt) {
  for (int const front_first_u : {0, 20}) {
    Schematic picture;
    picture.add({front_first_u, 70}, {80, 100}, front);
    picture.add({0, 50}, {80, 70}, [](Pixel p) {
      double const from_middle = (p.u - 39.5) / 40.0;
      return 1.0 / (1.0 / 1.1 + 3 * 0.00287 * from_middle * from_middle);
    });
    picture.add_depth({front_first_u, 70}, {front_first_u + 16, 72}, [](Pixel) { return 1.1; });
    picture.add_depth({64, 70}, {80, 72}, [](Pixel) { return 1.1; });
    EXPECT_EQ(picture.joins(std::nullopt), front_first_u == 0) << front_first_u;
  }
}

// Chairs behind a table are not its inside, however they bend.
TEST(JoinParts, ATableTopHasNoInside) {
  EXPECT_TRUE(vessel(hollow_inside).joins(Vector3d(0, -1, 0)));
  // The front's normal is along the axis.
  EXPECT_FALSE(vessel(hollow_inside).joins(Vector3d(0, 0, -1)));
}

// The camera looks straight down on a lid.
TEST(JoinParts, WhatDoesNotRiseAboveALevelSurfaceIsItsRim) {
  auto const lid_with = [](auto const& rim_m) {
    Schematic picture;
    picture.add({60, 70}, {140, 100}, front);
    picture.add({140, 74}, {152, 92}, rim_m);
    return picture.joins(Vector3d(0, 0, -1));
  };
  auto const raised = [](double quanta) {
    return [=](Pixel) { return 1.0 / (1.0 + 0.00287 * quanta); };
  };
  EXPECT_TRUE(lid_with(front));
  EXPECT_TRUE(lid_with(raised(1.5)));
  EXPECT_TRUE(lid_with(raised(-4.0))) << "it hangs";
  EXPECT_FALSE(lid_with(raised(2.5)));
  EXPECT_FALSE(lid_with([&](Pixel p) { return p.u < 150 ? 1.0 : raised(2.5)(p); }))
      << "a sixth of it";
}

}  // namespace
}  // namespace credo
