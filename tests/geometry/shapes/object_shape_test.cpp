#include "geometry/shapes/object_shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/shapes/mesh_edges.hpp"
#include "geometry/shapes/outline.hpp"
#include "geometry/shapes/solid.hpp"
#include "geometry/shapes/triangle.hpp"
#include "support/meshes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

Vector3d random_point(std::mt19937& generator, double reach) {
  std::uniform_real_distribution<double> spread(-reach, reach);
  double const x = spread(generator);
  double const y = spread(generator);
  return {x, y, spread(generator)};
}

std::array<Solid, 3> const kSolids = {Solid(BoxSolid{{-0.1, -0.2, 0}, {0.1, 0.2, 0.3}}),
                                      Solid(CylinderSolid{0.12, 0.25}), Solid(SphereSolid{0.15})};

// Against a mesh of the solid: exact for the box, within the polygon's sagitta for the round ones.
TEST(SolidDistance, IsThatToItsMesh) {
  std::mt19937 generator(7);
  for (Solid const& solid : kSolids) {
    TriangleMesh const mesh = mesh_of(solid);
    ASSERT_TRUE(is_closed(edges_of(mesh)));
    bool const box = std::holds_alternative<BoxSolid>(solid);
    for (int i = 0; i < 300; ++i) {
      Vector3d const p = random_point(generator, 0.4);
      EXPECT_NEAR(distance_to(solid, p).distance_m, literal_mesh_distance(mesh, p),
                  box ? 1e-7 : 2e-3);
    }
  }
}

TEST(SolidDistance, TheNormalIsTheWayOut) {
  std::mt19937 generator(8);
  for (Solid const& solid : kSolids) {
    for (int i = 0; i < 300; ++i) {
      Vector3d const p = random_point(generator, 0.4);
      SurfaceDistance const surface = distance_to(solid, p);
      EXPECT_NEAR(surface.normal.norm(), 1.0, 1e-12);
      EXPECT_NEAR(distance_to(solid, p - surface.distance_m * surface.normal).distance_m, 0.0,
                  1e-12);
    }
  }
}

TEST(SolidDistance, OnTheAxisAndInTheMiddleItIsFinite) {
  SurfaceDistance const axis = distance_to(CylinderSolid{0.1, 1.0}, {0, 0, 0.5});
  EXPECT_NEAR(axis.distance_m, -0.1, 1e-12);
  EXPECT_NEAR(axis.normal.norm(), 1.0, 1e-12);
  SurfaceDistance const middle = distance_to(SphereSolid{0.2}, {0, 0, 0.2});
  EXPECT_NEAR(middle.distance_m, -0.2, 1e-12);
  EXPECT_NEAR(middle.normal.norm(), 1.0, 1e-12);
}

TEST(Triangle, EachPartIsNearestToWhatLiesBeforeIt) {
  // Obtuse, so that some points lie beyond one edge and are nearest to another's end.
  std::array<Vector3d, 3> const corners = {Vector3d(0, 0, 0), Vector3d(4, 0, 0),
                                           Vector3d(-2, 1, 0)};
  EXPECT_EQ(nearest_on_triangle(corners, {0.5, 0.3, 2}).part, TrianglePart::kFace);
  EXPECT_EQ(nearest_on_triangle(corners, {2, -1, 1}).part, TrianglePart::kEdge0);
  EXPECT_EQ(nearest_on_triangle(corners, {1.5, 3, 0}).part, TrianglePart::kEdge1);
  EXPECT_EQ(nearest_on_triangle(corners, {-1.2, 0.3, 1}).part, TrianglePart::kEdge2);
  EXPECT_EQ(nearest_on_triangle(corners, {-0.2, -1, 0}).part, TrianglePart::kCorner0);
  EXPECT_EQ(nearest_on_triangle(corners, {6, 0, 0}).part, TrianglePart::kCorner1);
  EXPECT_EQ(nearest_on_triangle(corners, {-5, 1.5, 3}).part, TrianglePart::kCorner2);
}

TEST(Triangle, NoPointOfItIsNearer) {
  std::mt19937 generator(9);
  for (int i = 0; i < 200; ++i) {
    std::array<Vector3d, 3> const c = {random_point(generator, 1), random_point(generator, 1),
                                       random_point(generator, 1)};
    Vector3d const p = random_point(generator, 2);
    double const nearest = (nearest_on_triangle(c, p).point - p).norm();
    double sampled = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 60;
    for (int a = 0; a <= kSteps; ++a) {
      for (int b = 0; a + b <= kSteps; ++b) {
        Vector3d const q = c[0] + (a * (c[1] - c[0]) + b * (c[2] - c[0])) / kSteps;
        sampled = std::min(sampled, (q - p).norm());
      }
    }
    EXPECT_LE(nearest, sampled + 1e-12);
    EXPECT_GE(nearest, sampled - 0.05);
  }
}

TEST(MeshDistance, EqualsTryingEveryTriangle) {
  TriangleMesh const mesh = wavy_ring(24, 12);
  MeshDistance const distance(mesh);
  ASSERT_TRUE(distance.closed());
  std::mt19937 generator(10);
  int inside = 0;
  for (int i = 0; i < 1000; ++i) {
    Vector3d const p = random_point(generator, i % 2 == 0 ? 0.25 : 0.15);
    double const expected = literal_mesh_distance(mesh, p);
    EXPECT_NEAR(distance(p).distance_m, expected, 1e-12) << p.transpose();
    inside += expected < 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 60);
}

// Nearest to an edge or a corner, where the normal of one face alone would tell the wrong side.
// A box's faces are its mesh's triangles; a mesh is asked triangle by triangle.
TEST(FacesNear, AreThoseOfTryingEveryTriangle) {
  std::mt19937 generator(11);
  BoxSolid const box{{-0.1, -0.2, 0}, {0.1, 0.2, 0.3}};
  for (TriangleMesh const& mesh : {mesh_of(box), wavy_ring(40, 20)}) {
    bool const is_box = mesh.triangles.size() == 12;
    MeshDistance const distance(mesh);
    int found = 0;
    for (int i = 0; i < 500; ++i) {
      Vector3d const p = random_point(generator, is_box ? 0.3 : 1.2);
      DirectionCone const cone{random_point(generator, 1.0).normalized(), 0.3};
      double const radius_m = is_box ? 0.15 : 0.4;
      bool expected = false;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<Vector3d, 3> corners;
        std::ranges::transform(mesh.triangles[t], corners.begin(), [&](std::uint32_t vertex) {
          return mesh.vertices[vertex].cast<double>();
        });
        expected = expected || (cone.holds(area_vector(mesh, t).normalized()) &&
                                (p - nearest_on_triangle(corners, p).point).norm() <= radius_m);
      }
      found += expected ? 1 : 0;
      EXPECT_EQ(distance.has_face_near(p, radius_m, cone), expected);
      if (is_box) {
        EXPECT_EQ(has_face_near(Solid(box), p, radius_m, cone), expected);
      }
    }
    EXPECT_GT(found, 20);
    EXPECT_LT(found, 480);
  }
}

TEST(FacesNear, OfRoundSolids) {
  Solid const can = CylinderSolid{0.1, 0.3};
  DirectionCone const up{Vector3d::UnitZ(), 0.9};
  DirectionCone const down{-Vector3d::UnitZ(), 0.9};
  DirectionCone const aside{Vector3d::UnitX(), 0.9};
  Vector3d const by_the_rim(0.1, 0, 0.29);
  EXPECT_TRUE(has_face_near(can, by_the_rim, 0.02, up));
  EXPECT_TRUE(has_face_near(can, by_the_rim, 0.02, aside));
  EXPECT_FALSE(has_face_near(can, by_the_rim, 0.005, up));
  EXPECT_FALSE(has_face_near(can, by_the_rim, 0.02, down));
  EXPECT_TRUE(has_face_near(can, {0.1, 0, 0.01}, 0.02, down));
  EXPECT_FALSE(has_face_near(can, {-0.1, 0, 0.15}, 0.02, aside)) << "the far side faces away";
  Solid const ball = SphereSolid{0.1};
  EXPECT_TRUE(has_face_near(ball, {0.11, 0, 0.1}, 0.02, aside));
  EXPECT_FALSE(has_face_near(ball, {0.11, 0, 0.1}, 0.005, aside));
  EXPECT_FALSE(has_face_near(ball, {0.11, 0, 0.1}, 0.02, up));
}

TEST(FacesNear, AnOpenMeshMayBeSeenFromItsBack) {
  TriangleMesh mesh = mesh_of(BoxSolid{{-1, -1, 0}, {1, 1, 1}});
  DirectionCone const down{-Vector3d::UnitZ(), 0.9};
  EXPECT_FALSE(MeshDistance(mesh).has_face_near({0, 0, 1}, 0.1, down));
  std::erase_if(mesh.triangles, [&](auto const& corners) {
    return std::ranges::all_of(
        corners, [&](std::uint32_t vertex) { return mesh.vertices[vertex].z() == 0.0F; });
  });
  EXPECT_TRUE(MeshDistance(mesh).has_face_near({0, 0, 1}, 0.1, down));
}

TEST(MeshDistance, TellsTheSideBeforeSharpEdges) {
  TriangleMesh const mesh = mesh_of(BoxSolid{{-1, -1, 0}, {1, 1, 0.01}});
  MeshDistance const distance(mesh);
  for (double const off : {1e-6, 1e-3, 0.5}) {
    EXPECT_GT(distance({1 + off, 1 + off, 0.01 + 0.2 * off}).distance_m, 0);
    EXPECT_GT(distance({1 + 0.1 * off, 0.3, -off}).distance_m, 0);
    EXPECT_GT(distance({1 + off, 0.3, 0.01 + 0.1 * off}).distance_m, 0);
  }
  EXPECT_NEAR(distance({0.999, 0.999, 0.0095}).distance_m, -0.0005, 1e-9);
}

TEST(MeshDistance, AnOpenMeshHasNoInside) {
  TriangleMesh mesh = mesh_of(BoxSolid{{-1, -1, -1}, {1, 1, 1}});
  mesh.triangles.pop_back();
  MeshDistance const distance(mesh);
  EXPECT_FALSE(distance.closed());
  EXPECT_NEAR(distance({0, -0.9, 0}).distance_m, 0.1, 1e-6);
  EXPECT_NEAR(distance({0, -1.1, 0}).distance_m, 0.1, 1e-6);
}

TEST(MeshDistance, RefusesWhatIsNoMesh) {
  EXPECT_THROW(MeshDistance(TriangleMesh{}), std::logic_error);
  EXPECT_THROW(MeshDistance({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}}), std::logic_error);
  MeshDistance const distance(mesh_of(kSolids[0]));
  EXPECT_THROW(distance({NAN, 0, 0}), std::logic_error);
}

TEST(MeshEdges, ThreeTrianglesOnAnEdgeCloseNothing) {
  TriangleMesh mesh = mesh_of(kSolids[0]);
  EXPECT_EQ(edges_of(mesh).size(), 18U);
  EXPECT_TRUE(is_closed(edges_of(mesh)));
  mesh.vertices.emplace_back(9, 9, 9);
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], 8});
  EXPECT_FALSE(is_closed(edges_of(mesh)));
  EXPECT_FALSE(is_closed({}));
  // Turned over, one face runs along its edges the same way as its neighbours.
  mesh = mesh_of(kSolids[0]);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_FALSE(is_closed(edges_of(mesh)));
}

TEST(ObjectShape, ATableIsInsideItsTopAndLegsOnly) {
  ObjectShape const table({"table", table_on_base({{1.2, 0.8}, 0.7, 0.04, 0.06}), {}});
  EXPECT_TRUE(table.closed());
  EXPECT_NEAR((table.bounds().sizes() - Vector3d(1.2, 0.8, 0.7)).norm(), 0, 1e-12);
  EXPECT_LT(table.distance_to({0, 0, 0.68}).distance_m, 0);
  EXPECT_LT(table.distance_to({0.57, 0.37, 0.3}).distance_m, 0);
  EXPECT_LT(table.distance_to({0.57, 0.37, 0.6599}).distance_m, 0) << "where a leg meets the top";
  EXPECT_NEAR(table.distance_to({0, 0, 0.3}).distance_m, 0.36, 1e-12) << "under the top";
  EXPECT_NEAR(table.distance_to({0, 0, 0.71}).distance_m, 0.01, 1e-12);
  EXPECT_NEAR(table.distance_to({0, 0, 0.71}).normal.z(), 1, 1e-12);
}

TEST(ObjectShape, KnowsAMeshByItsBounds) {
  ObjectShape const ring({"ring", wavy_ring(24, 12), {}});
  EXPECT_TRUE(ring.closed());
  EXPECT_NEAR(ring.bounds().sizes().x(), 0.3, 0.03);
  EXPECT_GT(ring.distance_to({0, 0, 0}).distance_m, 0) << "the hole of a ring is outside";
  EXPECT_THROW(ObjectShape({"nothing", std::vector<Solid>{}, {}}), std::logic_error);
}

TEST(Outline, OfABoxIsItsTwelveEdges) {
  std::vector<OutlineEdge> const box = outline_of({"box", {std::vector<Solid>{kSolids[0]}}, {}});
  EXPECT_EQ(box.size(), 12U);
  for (OutlineEdge const& edge : box) {
    EXPECT_TRUE(edge.sharp);
  }
}

TEST(Outline, OfACylinderHasRimsAndSides) {
  std::vector<OutlineEdge> const cylinder =
      outline_of({"can", {std::vector<Solid>{kSolids[1]}}, {}});
  std::size_t sharp = 0;
  for (OutlineEdge const& edge : cylinder) {
    sharp += edge.sharp ? 1U : 0U;
  }
  EXPECT_EQ(sharp, 64U);
  EXPECT_EQ(cylinder.size(), 96U);
}

}  // namespace
}  // namespace credo::test
