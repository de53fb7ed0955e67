#include "geometry/thickness.hpp"

#include <gtest/gtest.h>

namespace credo {
namespace {

constexpr LabelCode kThing = kFirstStuff;

void paint(LabelMap& labels, int left, int top, int width, int height, LabelCode label) {
  for (int v = top; v < top + height; ++v) {
    for (int u = left; u < left + width; ++u) {
      labels[{u, v}] = label;
    }
  }
}

TEST(Thickness, OfASquareIsItsEdge) {
  LabelMap labels(40, 40, kFloor);
  paint(labels, 10, 10, 7, 7, kThing);
  EXPECT_DOUBLE_EQ(thickness_px(labels).at(kThing), 7.0);
}

TEST(Thickness, OfALongStripIsTwiceItsWidth) {
  LabelMap labels(1000, 20, kFloor);
  paint(labels, 10, 10, 900, 3, kThing);
  EXPECT_NEAR(thickness_px(labels).at(kThing), 6.0, 0.03);
}

TEST(Thickness, ShrinksWithHoles) {
  LabelMap labels(40, 40, kFloor);
  paint(labels, 10, 10, 10, 10, kThing);
  labels[{15, 15}] = kNoDepth;
  EXPECT_DOUBLE_EQ(thickness_px(labels).at(kThing), 4.0 * 99 / 44);
}

TEST(Thickness, WhatLeavesTheImageHasNoOutlineThere) {
  LabelMap labels(40, 40, kFloor);
  paint(labels, 0, 10, 10, 10, kThing);
  EXPECT_DOUBLE_EQ(thickness_px(labels).at(kThing), 4.0 * 100 / 30);
  labels = LabelMap(5, 4, kThing);
  EXPECT_DOUBLE_EQ(thickness_px(labels).at(kThing), 80.0) << "all of it";
}

TEST(Thickness, IsOfStuffAloneAndOfEach) {
  LabelMap labels(40, 40, kFloor);
  paint(labels, 0, 0, 5, 40, kFirstWall);
  paint(labels, 10, 10, 4, 4, kThing);
  paint(labels, 20, 20, 6, 6, kThing + 1);
  auto const thickness = thickness_px(labels);
  EXPECT_EQ(thickness.size(), 2U);
  EXPECT_DOUBLE_EQ(thickness.at(kThing), 4.0);
  EXPECT_DOUBLE_EQ(thickness.at(kThing + 1), 6.0);
  EXPECT_TRUE(thickness_px({}).empty());
}

}  // namespace
}  // namespace credo
