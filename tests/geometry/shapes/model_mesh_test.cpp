#include "geometry/shapes/model_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "geometry/shapes/mesh_edges.hpp"
#include "geometry/shapes/solid_distance.hpp"
#include "support/meshes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

ObjectModel model_of(std::vector<Solid> solids) {
  return {"made here", std::move(solids), {}};
}

double area_of(TriangleMesh const& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area += area_vector(mesh, t).norm() / 2.0;
  }
  return area;
}

Vector3d middle_of(TriangleMesh const& mesh, std::size_t t) {
  auto const& [a, b, c] = mesh.triangles[t];
  return ((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0F).cast<double>();
}

/// Corners and faces lie on the solid, and face outward.
void expect_surface_of(Solid const& solid, double tolerance_m) {
  TriangleMesh const mesh = mesh_of(model_of({solid}));
  for (auto const& vertex : mesh.vertices) {
    EXPECT_NEAR(distance_to(solid, vertex.cast<double>()).distance_m, 0.0, 1e-6);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    SurfaceDistance const at = distance_to(solid, middle_of(mesh, t));
    EXPECT_NEAR(at.distance_m, 0.0, tolerance_m);
    EXPECT_GT(at.normal.dot(area_vector(mesh, t).normalized()), 0.9) << t;
  }
  EXPECT_TRUE(is_closed(edges_of(mesh)));
}

TEST(ModelMesh, OfABoxIsTheBox) {
  BoxSolid const box{{-0.1, -0.2, 0.0}, {0.3, 0.2, 0.5}};
  expect_surface_of(box, 1e-6);
  EXPECT_NEAR(area_of(mesh_of(model_of({box}))), 2 * (0.4 * 0.4 + 0.4 * 0.5 + 0.4 * 0.5), 1e-6);
}

TEST(ModelMesh, OfRoundBodiesIsNearlyTheBody) {
  // Of 32 sides, the middle of one lies so much inside.
  double const inside = 2.0 * (1.0 - std::cos(std::numbers::pi / 32.0));
  expect_surface_of(CylinderSolid{0.1, 0.3}, 0.1 * inside);
  expect_surface_of(SphereSolid{0.1}, 0.1 * inside);
  double const sphere_m2 = 4.0 * std::numbers::pi * 0.01;
  EXPECT_NEAR(area_of(mesh_of(model_of({SphereSolid{0.1}}))), sphere_m2, 0.02 * sphere_m2);
}

TEST(ModelMesh, OfSomeBodiesIsThatOfEach) {
  BoxSolid const box{{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.1}};
  SphereSolid const sphere{0.08};
  CylinderSolid const can{0.05, 0.4};
  TriangleMesh const joined = mesh_of(model_of({box, sphere, can}));
  double area = 0.0;
  std::size_t triangles = 0;
  for (Solid const& solid : std::vector<Solid>{box, sphere, can}) {
    TriangleMesh const one = mesh_of(model_of({solid}));
    area += area_of(one);
    triangles += one.triangles.size();
  }
  ASSERT_EQ(joined.triangles.size(), triangles);
  EXPECT_NEAR(area_of(joined), area, 1e-6);
  for (std::size_t t = 0; t < triangles; ++t) {
    Solid const& own = t < 12 ? Solid(box) : t < triangles - 128 ? Solid(sphere) : Solid(can);
    EXPECT_NEAR(distance_to(own, middle_of(joined, t)).distance_m, 0.0, 1e-3) << t;
  }
}

TEST(ModelMesh, AMeshStaysAsItIs) {
  TriangleMesh const ring = wavy_ring(12, 8);
  TriangleMesh const same = mesh_of(ObjectModel{"ring", ring, {}});
  EXPECT_EQ(same.vertices, ring.vertices);
  EXPECT_EQ(same.triangles, ring.triangles);
}

}  // namespace
}  // namespace credo::test
