#include "geometry/shapes/surface_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/shapes/object_shape.hpp"
#include "support/meshes.hpp"

namespace credo::test {
namespace {

/// All on the surface, and no part of the surface far from all: points of a much denser sample are
/// near to one of the sparse.
void expect_even(ObjectModel const& model, double spacing_m) {
  ObjectShape const shape(model);
  auto const points = surface_points(model, spacing_m);
  for (Eigen::Vector3d const& point : points) {
    EXPECT_NEAR(shape.distance_to(point).distance_m, 0.0, 1e-6);
  }
  for (Eigen::Vector3d const& dense : surface_points(model, spacing_m / 5.0)) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (Eigen::Vector3d const& point : points) {
      nearest_m = std::min(nearest_m, (point - dense).norm());
    }
    EXPECT_LE(nearest_m, 1.8 * spacing_m);
  }
}

TEST(SurfacePoints, LieEvenlyOnEveryShape) {
  expect_even({"box", std::vector<Solid>{box_on_base({0.3, 0.2, 0.5})}, {}}, 0.05);
  expect_even({"can", std::vector<Solid>{CylinderSolid{0.1, 0.4}}, {}}, 0.04);
  expect_even({"ball", std::vector<Solid>{SphereSolid{0.2}}, {}}, 0.05);
  expect_even({"table", table_on_base({{0.8, 1.2}, 0.7, 0.04, 0.06}), {}}, 0.06);
}

TEST(SurfacePoints, LieOnMeshesOfSmallTriangles) {
  TriangleMesh const mesh = wavy_ring(60, 30);
  auto const points = surface_points({"ring", mesh, {}}, 0.1);
  EXPECT_LT(points.size(), mesh.triangles.size()) << "one in each cell, not three a triangle";
  for (Eigen::Vector3d const& point : points) {
    EXPECT_NEAR(literal_mesh_distance(mesh, point), 0.0, 1e-6);
  }
}

TEST(SurfacePoints, SpacingMustBePositive) {
  ObjectModel const box{"box", std::vector<Solid>{box_on_base({1, 1, 1})}, {}};
  EXPECT_THROW(surface_points(box, 0.0), std::logic_error);
}

}  // namespace
}  // namespace credo::test
