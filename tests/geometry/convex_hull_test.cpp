#include "geometry/convex_hull.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace credo::test {
namespace {

using Points = std::vector<Eigen::Vector3d>;

double enclosed_volume(Points const& points, std::vector<HullFace> const& faces) {
  double volume = 0.0;
  for (auto const& [a, b, c] : faces) {
    volume += points[a].dot(points[b].cross(points[c])) / 6.0;
  }
  return volume;
}

void expect_closed(std::vector<HullFace> const& faces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (HullFace const& face : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[{face[i], face[(i + 1) % 3]}];
    }
  }
  for (auto const& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

Points cube() {
  Points points;
  for (int i = 0; i < 8; ++i) {
    points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  }
  return points;
}

TEST(ConvexHull, OfACubeIsTwelveTrianglesAroundIt) {
  Points points = cube();
  points.emplace_back(0.5, 0.5, 0.5);
  auto const faces = convex_hull(points);
  EXPECT_EQ(faces.size(), 12U);
  expect_closed(faces);
  EXPECT_NEAR(enclosed_volume(points, faces), 1.0, 1e-4);
}

TEST(ConvexHull, HoldsEveryPointOfACloud) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Points points;
  for (int i = 0; i < 300; ++i) {
    points.emplace_back(normal(random), 2.0 * normal(random), 0.3 * normal(random));
  }
  auto const faces = convex_hull(points);
  expect_closed(faces);
  EXPECT_GT(enclosed_volume(points, faces), 0.0);
  for (auto const& [a, b, c] : faces) {
    Eigen::Vector3d const normal_out =
        (points[b] - points[a]).cross(points[c] - points[a]).normalized();
    for (Eigen::Vector3d const& point : points) {
      EXPECT_LT(normal_out.dot(point - points[a]), 1e-3);
    }
  }
}

TEST(ConvexHull, OfWhatHasNoVolumeIsEmpty) {
  EXPECT_TRUE(convex_hull(Points{}).empty());
  EXPECT_TRUE(convex_hull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).empty());
  EXPECT_TRUE(convex_hull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 3, 0}}).empty());
}

TEST(ConvexHull, InAPlaneKeepsCornersOnly) {
  std::vector<Eigen::Vector2d> const hull =
      convex_polygon({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}});
  ASSERT_EQ(hull.size(), 4U);
  EXPECT_EQ(hull[0], Eigen::Vector2d(0, 0));
  EXPECT_EQ(hull[1], Eigen::Vector2d(2, 0));
  EXPECT_EQ(hull[2], Eigen::Vector2d(2, 2));
  EXPECT_EQ(hull[3], Eigen::Vector2d(0, 2));
  EXPECT_LT(convex_polygon({{0, 0}, {1, 1}, {2, 2}}).size(), 3U);
}

TEST(ConvexHull, DepthInsideIsThatToTheNearestSide) {
  std::vector<Eigen::Vector2d> const square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_DOUBLE_EQ(depth_inside(square, {0.5, 1.0}), 0.5);
  EXPECT_DOUBLE_EQ(depth_inside(square, {1.0, 2.25}), -0.25);
  EXPECT_TRUE(std::isinf(depth_inside({{0, 0}, {1, 0}}, {0.5, 0.0})));
}

}  // namespace
}  // namespace credo::test
