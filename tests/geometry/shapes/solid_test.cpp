#include "geometry/shapes/solid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::test {
namespace {

using Eigen::Vector3d;

Solid const kBox = BoxSolid{{-1, -2, 0}, {1, 2, 3}};
Solid const kCylinder = CylinderSolid{0.5, 2.0};
Solid const kSphere = SphereSolid{0.75};

void expect_entry(Solid const& solid, Vector3d const& origin, Vector3d const& direction,
                  double distance, Vector3d const& normal) {
  std::optional<RayEntry> const entry = enter(solid, origin, direction);
  ASSERT_TRUE(entry.has_value());
  EXPECT_NEAR(entry->distance, distance, 1e-12);
  EXPECT_NEAR((entry->normal - normal).norm(), 0.0, 1e-12);
}

TEST(Solid, ABoxIsEnteredThroughTheFaceInTheWay) {
  expect_entry(kBox, {-4, 0, 1}, {1, 0, 0}, 3.0, {-1, 0, 0});
  expect_entry(kBox, {4, 0, 1}, {-2, 0, 0}, 1.5, {1, 0, 0});
  expect_entry(kBox, {0, 5, 1}, {0, -1, 0}, 3.0, {0, 1, 0});
  expect_entry(kBox, {0, 0, 9}, {0, 0, -1}, 6.0, {0, 0, 1});
  // x = -1 at a distance of 3, z = 0 at 2: the later one.
  expect_entry(kBox, {-4, 0, -2}, {1, 0, 1}, 3.0, {-1, 0, 0});
}

TEST(Solid, ACylinderHasASideAndTwoEnds) {
  expect_entry(kCylinder, {-3, 0, 1}, {1, 0, 0}, 2.5, {-1, 0, 0});
  double const half = std::sqrt(0.25 - 0.09);
  expect_entry(kCylinder, {-3, 0.3, 1}, {1, 0, 0}, 3.0 - half,
               Vector3d(-half, 0.3, 0).normalized());
  expect_entry(kCylinder, {0.2, 0.1, 5}, {0, 0, -1}, 3.0, {0, 0, 1});
  expect_entry(kCylinder, {0.2, 0.1, -5}, {0, 0, 1}, 5.0, {0, 0, -1});
  EXPECT_FALSE(enter(kCylinder, {-3, 0.6, 1}, {1, 0, 0}));
  EXPECT_FALSE(enter(kCylinder, {-3, 0, 2.1}, {1, 0, 0}));
  EXPECT_FALSE(enter(kCylinder, {0.6, 0, 5}, {0, 0, -1}));
}

TEST(Solid, ASphereRestsOnItsBase) {
  expect_entry(kSphere, {-3, 0, 0.75}, {1, 0, 0}, 2.25, {-1, 0, 0});
  expect_entry(kSphere, {0, 0, 4}, {0, 0, -1}, 2.5, {0, 0, 1});
  double const half = std::sqrt(0.75 * 0.75 - 0.36);
  expect_entry(kSphere, {-3, 0.6, 0.75}, {1, 0, 0}, 3.0 - half,
               Vector3d(-half, 0.6, 0).normalized());
  EXPECT_FALSE(enter(kSphere, {-3, 0, 1.51}, {1, 0, 0}));
}

TEST(Solid, IsNotEnteredFromInsideFromBehindOrPast) {
  for (Solid const& solid : {kBox, kCylinder, kSphere}) {
    EXPECT_FALSE(enter(solid, {0, 0, 0.5}, {1, 0, 0})) << "from inside";
    EXPECT_FALSE(enter(solid, {-9, 0, 0.5}, {-1, 0, 0})) << "behind";
    EXPECT_FALSE(enter(solid, {-9, 0, 0.5}, {1, 0, 5})) << "past";
  }
}

TEST(Solid, RaysAlongAFaceDoNoHarm) {
  for (double const x : {-1.0, 1.0}) {
    std::optional<RayEntry> const entry = enter(kBox, {x, -5, 1}, {0, 1, 0});
    if (entry.has_value()) {
      EXPECT_NEAR(entry->distance, 3.0, 1e-12);
    }
  }
  EXPECT_FALSE(enter(kBox, {1.001, -5, 1}, {0, 1, 0}));
}

}  // namespace
}  // namespace credo::test
