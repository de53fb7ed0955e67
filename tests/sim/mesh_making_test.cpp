#include "sim/mesh_making.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/shapes/mesh_edges.hpp"

namespace credo::test {
namespace {

double volume_m3(TriangleMesh const& mesh) {
  double volume = 0.0;
  for (auto const& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].cast<double>().dot(
        mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>()));
  }
  return volume / 6.0;
}

/// Closed, and outside is outside.
void expect_solid(TriangleMesh const& mesh, double expected_m3, double tolerance) {
  EXPECT_TRUE(is_closed(edges_of(mesh)));
  EXPECT_NEAR(volume_m3(mesh) / expected_m3, 1.0, tolerance);
}

constexpr double kPi = std::numbers::pi;

TEST(MeshMaking, WhatIsTurnedIsClosedAndAsLargeAsItsOutlineSays) {
  TriangleMesh const cylinder = revolved({{0, 0}, {0.1, 0}, {0.1, 0.3}, {0, 0.3}});
  expect_solid(cylinder, kPi * 0.1 * 0.1 * 0.3, 0.01);
  TriangleMesh const pot =
      revolved({{0, 0}, {0.1, 0}, {0.1, 0.3}, {0.08, 0.3}, {0.08, 0.02}, {0, 0.02}});
  expect_solid(pot, kPi * (0.01 * 0.3 - 0.0064 * 0.28), 0.01);
}

TEST(MeshMaking, BoxesAndPrisms) {
  expect_solid(block({0.1, 0.2, 0.3}), 0.006, 1e-6);
  expect_solid(prism({{0, 0}, {0.2, 0}, {0, 0.1}}, -0.1, 0.2), 0.003, 1e-5);
}

TEST(MeshMaking, ABentBarIsClosed) {
  TriangleMesh const straight = bar({{0, 0, 0}, {0, 0, 1}}, 0.1);
  expect_solid(straight, 12 * 0.5 * std::sin(kPi / 6) * 0.01, 1e-5);
  TriangleMesh const bent = bar({{0, 0, 0}, {0, 0, 0.5}, {0.3, 0, 0.8}, {0.3, 0.4, 1}}, 0.05);
  EXPECT_TRUE(is_closed(edges_of(bent)));
  EXPECT_GT(volume_m3(bent), 0.0);
}

TEST(MeshMaking, JoinedMovedAndCentred) {
  TriangleMesh const part = block({0.2, 0.2, 0.2});
  TriangleMesh const pair =
      joined({part, moved(part, Se3(Eigen::Quaterniond::Identity(), {1, 0, 0}))});
  expect_solid(pair, 0.016, 1e-5);
  Eigen::AlignedBox3f box;
  for (Eigen::Vector3f const& vertex : centred(pair).vertices) {
    box.extend(vertex);
  }
  EXPECT_LT(box.center().norm(), 1e-6);
  EXPECT_NEAR(box.sizes().x(), 1.2, 1e-6);
}

TEST(MeshMaking, RefusesTooFewPoints) {
  EXPECT_THROW(revolved({{0, 0}, {0, 1}}), std::logic_error);
  EXPECT_THROW(prism({{0, 0}, {1, 1}}, 0, 1), std::logic_error);
  EXPECT_THROW(bar({{0, 0, 0}}, 1), std::logic_error);
}

}  // namespace
}  // namespace credo::test
