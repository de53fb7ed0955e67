#include "geometry/shapes/triangle.hpp"

#include <gtest/gtest.h>

#include <random>

namespace credo::test {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

Corners const kTriangle = {Vector3d(0, 0, 2), Vector3d(4, 0, 2), Vector3d(0, 4, 2)};

TEST(Triangle, IsMetFromBothSidesInLengthsOfTheRay) {
  EXPECT_EQ(distance_to_triangle(kTriangle, {1, 1, 0}, {0, 0, 1}), 2.0);
  EXPECT_EQ(distance_to_triangle(kTriangle, {1, 1, 0}, {0, 0, 4}), 0.5);
  EXPECT_EQ(distance_to_triangle(kTriangle, {1, 1, 5}, {0, 0, -1}), 3.0);
  EXPECT_EQ(distance_to_triangle(kTriangle, {0, 0, 0}, {0.5, 0.25, 1}), 2.0);
}

TEST(Triangle, IsMissedBesideBehindAndAlong) {
  EXPECT_FALSE(distance_to_triangle(kTriangle, {3, 3, 0}, {0, 0, 1}).has_value());
  EXPECT_FALSE(distance_to_triangle(kTriangle, {-1, 1, 0}, {0, 0, 1}).has_value());
  EXPECT_FALSE(distance_to_triangle(kTriangle, {1, 1, 0}, {0, 0, -1}).has_value()) << "behind";
  EXPECT_FALSE(distance_to_triangle(kTriangle, {1, 1, 0}, {1, 1, 0}).has_value()) << "beside it";
  EXPECT_FALSE(distance_to_triangle(kTriangle, {-1, 1, 2}, {1, 0, 0}).has_value()) << "in it";
}

TEST(Triangle, ItsBorderIsPartOfIt) {
  EXPECT_EQ(distance_to_triangle(kTriangle, {2, 0, 0}, {0, 0, 1}), 2.0);
  EXPECT_EQ(distance_to_triangle(kTriangle, {2, 2, 0}, {0, 0, 1}), 2.0);
  EXPECT_EQ(distance_to_triangle(kTriangle, {0, 0, 0}, {0, 0, 1}), 2.0);
}

// Rays from anywhere to points of an edge, which rounding puts to one side or the other of it.
TEST(Triangle, NeighboursLeaveNoGap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  auto const point = [&] { return Vector3d(number(random), number(random), number(random)); };
  for (int i = 0; i < 20000; ++i) {
    Vector3d const a = point();
    Vector3d const b = point();
    Vector3d const aside = point();
    Corners const left = {a, b, 0.5 * (a + b) + aside};
    Corners const right = {b, a, 0.5 * (a + b) - aside};
    Vector3d const eye = 4 * point();
    Vector3d const ray = a + 0.5 * (1 + number(random)) * (b - a) - eye;
    ASSERT_TRUE(distance_to_triangle(left, eye, ray).has_value() ||
                distance_to_triangle(right, eye, ray).has_value())
        << i;
  }
}

}  // namespace
}  // namespace credo::test
