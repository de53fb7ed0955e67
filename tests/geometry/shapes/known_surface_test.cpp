#include "geometry/shapes/known_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/shapes/object_shape.hpp"

namespace credo {
namespace {

ObjectModel box_of(double size_m) {
  Eigen::Vector3d const half = Eigen::Vector3d::Constant(size_m / 2);
  return {"box", std::vector<Solid>{BoxSolid{-half, half}}, {}};
}

/// Whether points lie on the surface, and no place of it is far from one.
void expect_covers(ObjectModel const& model, double size_m) {
  ObjectShape const shape(model);
  KnownSurface const surface = known_surfaces({{model.name, model}}).at(model.name);
  for (Eigen::Vector3f const& point : surface.points_model) {
    // The mean of the points of a cell that holds an edge lies within the body.
    EXPECT_LT(std::abs(shape.distance_to(point.cast<double>()).distance_m), surface.spacing_m);
  }
  KnownSurface const dense = known_surfaces({{model.name, model}}).at(model.name);
  EXPECT_GT(surface.points_model.size(), 250U);
  EXPECT_LT(surface.points_model.size(), 800U);
  EXPECT_GT(surface.spacing_m, size_m / 100);
}

TEST(KnownSurface, HasSomeHundredPointsWhateverTheSize) {
  for (double const size_m : {0.01, 0.2, 3.0}) {
    expect_covers(box_of(size_m), size_m);
  }
}

/// A sphere of many small triangles.
TriangleMesh fine_sphere() {
  constexpr int kRings = 80;
  TriangleMesh mesh;
  for (int i = 0; i <= kRings; ++i) {
    for (int j = 0; j < kRings; ++j) {
      double const polar = M_PI * i / kRings;
      double const azimuth = 2 * M_PI * j / kRings;
      mesh.vertices.emplace_back(static_cast<float>(0.1 * std::sin(polar) * std::cos(azimuth)),
                                 static_cast<float>(0.1 * std::sin(polar) * std::sin(azimuth)),
                                 static_cast<float>(0.1 * std::cos(polar)));
    }
  }
  auto const at = [&](int i, int j) { return static_cast<std::uint32_t>(i * kRings + j % kRings); };
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kRings; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TEST(KnownSurface, AFineMeshHasNoMore) {
  KnownSurface const surface =
      known_surfaces({{"sphere", {"sphere", fine_sphere(), {}}}}).at("sphere");
  EXPECT_GT(surface.points_model.size(), 200U);
  EXPECT_LT(surface.points_model.size(), 1000U);
  for (Eigen::Vector3f const& point : surface.points_model) {
    EXPECT_NEAR(point.norm(), 0.1, 0.005);
  }
}

// All of it on one side of the origin, and open.
TEST(KnownSurface, OfAMeshAnywhere) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 1, 1}, {1.2F, 1, 1}, {1, 1.2F, 1}};
  mesh.triangles = {{0, 1, 2}};
  KnownSurface const surface = known_surfaces({{"flap", {"flap", mesh, {}}}}).at("flap");
  EXPECT_GT(surface.points_model.size(), 200U);
  EXPECT_NEAR(surface.radius_m, std::sqrt(1.2 * 1.2 + 1.2 * 1.2 + 1.0), 1e-6);
}

TEST(KnownSurface, KeepsTheSymmetry) {
  ObjectModel model = box_of(0.1);
  model.symmetry.axis = SymmetryAxis{};
  EXPECT_TRUE(known_surfaces({{"box", model}}).at("box").symmetry.axis.has_value());
  EXPECT_TRUE(known_surfaces({}).empty());
}

TEST(KnownSurface, ThereMustBeOne) {
  TriangleMesh point;
  point.vertices = {Eigen::Vector3f::Zero()};
  point.triangles = {{0, 0, 0}};
  EXPECT_THROW((void)known_surfaces({{"point", {"point", point, {}}}}), std::logic_error);
}

}  // namespace
}  // namespace credo
