#include "detector/models/surface_sample.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "geometry/shapes/model_mesh.hpp"
#include "support/meshes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

constexpr float kSpacing_m = 0.01F;

TriangleMesh mesh_of_solid(Solid const& solid) {
  return mesh_of(ObjectModel{"made here", std::vector<Solid>{solid}, {}});
}
TriangleMesh box() {
  return mesh_of_solid(BoxSolid{{-0.1, -0.06, 0.0}, {0.1, 0.06, 0.1}});
}
TriangleMesh sphere() {
  return mesh_of_solid(SphereSolid{0.1});
}

float least_distance_m(std::vector<Vector3f> const& points) {
  float least = 1e9F;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      least = std::min(least, (points[i] - points[j]).norm());
    }
  }
  return least;
}

void expect_good_sample(TriangleMesh const& mesh, SurfaceSample const& sample) {
  ASSERT_EQ(sample.points.size(), sample.normals.size());
  EXPECT_GE(least_distance_m(sample.points), kSpacing_m * 0.99999F);
  auto const count = static_cast<float>(sample.points.size());
  float const most = sample.area_m2 / (kSpacing_m * kSpacing_m);
  EXPECT_LT(count, most);
  EXPECT_GT(count, 0.5F * most);
  for (std::size_t i = 0; i < sample.points.size(); i += 20) {
    EXPECT_NEAR(literal_mesh_distance(mesh, sample.points[i].cast<double>()), 0.0, 1e-6);
  }
  for (Vector3f const& normal : sample.normals) {
    EXPECT_NEAR(normal.norm(), 1.0F, 1e-5F);
  }
}

TEST(SurfaceSample, OfABoxLiesApartOnItsFaces) {
  SurfaceSample const sample = sample_surface(box(), kSpacing_m, 1);
  EXPECT_NEAR(sample.area_m2, 2.0F * (0.2F * 0.12F + 0.2F * 0.1F + 0.12F * 0.1F), 1e-6F);
  expect_good_sample(box(), sample);
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    // An edge turns by 90 degrees: normals are not evened out over it.
    EXPECT_NEAR(sample.normals[i].cwiseAbs().maxCoeff(), 1.0F, 1e-5F);
    Vector3f const from_middle = sample.points[i] - Vector3f(0, 0, 0.05F);
    EXPECT_GT(from_middle.dot(sample.normals[i]), 0.0F) << "outward";
  }
}

TEST(SurfaceSample, OfASphereHasItsNormals) {
  SurfaceSample const sample = sample_surface(sphere(), kSpacing_m, 1);
  EXPECT_NEAR(sample.area_m2, 0.1257F, 0.002F);
  expect_good_sample(sphere(), sample);
  float sum_evened = 0.0F;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    Vector3f const radial = (sample.points[i] - Vector3f(0, 0, 0.1F)).normalized();
    EXPECT_GT(sample.normals[i].dot(radial), std::cos(0.1F));
    sum_evened += std::acos(std::min(1.0F, sample.normals[i].dot(radial)));
  }
  // Faces of 32 sides are off by 0.06 rad on average, what is evened out by less.
  EXPECT_LT(sum_evened / static_cast<float>(sample.points.size()), 0.05F);
}

TEST(SurfaceSample, OfAWavyRing) {
  TriangleMesh const ring = wavy_ring(24, 12);
  SurfaceSample const sample = sample_surface(ring, kSpacing_m, 4);
  expect_good_sample(ring, sample);
}

TEST(SurfaceSample, ItsFirstPointsAreASampleOfAll) {
  std::vector<Vector3f> const points = sample_surface(sphere(), kSpacing_m, 1).points;
  std::array<int, 8> octants = {};
  std::size_t const count = points.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    Vector3f const p = points[i] - Vector3f(0, 0, 0.1F);
    ++octants.at((p.x() > 0 ? 1U : 0U) + (p.y() > 0 ? 2U : 0U) + (p.z() > 0 ? 4U : 0U));
  }
  for (int const in_octant : octants) {
    EXPECT_NEAR(in_octant, static_cast<double>(count) / 8.0,
                0.4 * static_cast<double>(count) / 8.0);
  }
}

TEST(SurfaceSample, IsTheSameForTheSameSeed) {
  SurfaceSample const one = sample_surface(box(), kSpacing_m, 5);
  SurfaceSample const same = sample_surface(box(), kSpacing_m, 5);
  SurfaceSample const other = sample_surface(box(), kSpacing_m, 6);
  EXPECT_EQ(one.points, same.points);
  EXPECT_EQ(one.normals, same.normals);
  EXPECT_NE(one.points, other.points);
}

TEST(SurfaceSample, WithoutASurfaceThereAreNoPoints) {
  EXPECT_TRUE(sample_surface({}, kSpacing_m, 1).points.empty());
  TriangleMesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.triangles = {{0, 1, 2}, {0, 0, 1}};
  SurfaceSample const sample = sample_surface(line, kSpacing_m, 1);
  EXPECT_TRUE(sample.points.empty());
  EXPECT_EQ(sample.area_m2, 0.0F);
}

TEST(SurfaceSample, TrianglesWithoutAnAreaChangeNothing) {
  TriangleMesh mesh = box();
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  mesh.triangles.push_back({2, 2, 2});
  SurfaceSample const sample = sample_surface(mesh, kSpacing_m, 1);
  EXPECT_EQ(sample.points, sample_surface(box(), kSpacing_m, 1).points);
}

TEST(Apart, KeepsWhatComesFirst) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> number(-0.05F, 0.05F);
  std::vector<Vector3f> points;
  for (int i = 0; i < 800; ++i) {
    points.emplace_back(number(random), number(random), number(random));
  }
  std::vector<std::uint32_t> literal;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    bool free = true;
    for (std::uint32_t const kept : literal) {
      free = free && (points[kept] - points[i]).squaredNorm() >= kSpacing_m * kSpacing_m;
    }
    if (free) {
      literal.push_back(i);
    }
  }
  EXPECT_EQ(apart(points, kSpacing_m), literal);
  EXPECT_TRUE(apart({}, kSpacing_m).empty());
}

}  // namespace
}  // namespace credo::test
