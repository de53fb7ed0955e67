#include "geometry/shapes/learned_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes/mesh_edges.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

constexpr float kRadius_m = 0.06F;

/// What a camera far away along a direction sees of a sphere.
SeenPoints half_sphere(Vector3f const& from, int count = 15000) {
  SeenPoints seen{{}, 100.0F * from};
  for (int i = 0; i < count; ++i) {
    float const z = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    float const turn = 2.39996323F * static_cast<float>(i);
    float const across = std::sqrt(1.0F - z * z);
    Vector3f const normal(across * std::cos(turn), across * std::sin(turn), z);
    if (normal.dot(from) > 0.0F) {
      seen.points.emplace_back(kRadius_m * normal);
    }
  }
  return seen;
}

TEST(LearnedSurface, OfOneViewIsHalfASurface) {
  LearnedSurface const learned = learned_surface({half_sphere(Vector3f::UnitX())});
  EXPECT_EQ(learned.points, half_sphere(Vector3f::UnitX()).points.size());
  EXPECT_LT(learned.used_points, learned.points) << "the rim is seen too flatly";
  EXPECT_GT(static_cast<double>(learned.used_points), 0.75 * static_cast<double>(learned.points));
  EXPECT_FALSE(is_closed(edges_of(learned.mesh)));
  for (Vector3f const& vertex : learned.mesh.vertices) {
    EXPECT_NEAR(vertex.norm(), kRadius_m, 0.001F);
    EXPECT_GT(vertex.x(), 0.0F);
  }
  for (std::size_t t = 0; t < learned.mesh.triangles.size(); ++t) {
    Vector3f const& corner = learned.mesh.vertices[learned.mesh.triangles[t][0]];
    EXPECT_GT(area_vector(learned.mesh, t).dot(corner.cast<double>()), 0.0) << "inside out";
  }
}

TEST(LearnedSurface, OfViewsAllAroundIsClosed) {
  std::vector<SeenPoints> views;
  for (int axis = 0; axis < 3; ++axis) {
    views.push_back(half_sphere(Vector3f::Unit(axis)));
    views.push_back(half_sphere(-Vector3f::Unit(axis)));
  }
  LearnedSurface const learned = learned_surface(views);
  EXPECT_TRUE(is_closed(edges_of(learned.mesh)));
  for (Vector3f const& vertex : learned.mesh.vertices) {
    EXPECT_NEAR(vertex.norm(), kRadius_m, 0.001F);
  }
}

TEST(LearnedSurface, TheGridIsAsFineAsThePointsAndTheSize) {
  EXPECT_EQ(learned_surface({half_sphere(Vector3f::UnitX())}).spacing_m, 0.003F);
  SeenPoints const sparse = half_sphere(Vector3f::UnitX(), 2500);
  EXPECT_NEAR(learned_surface({sparse}).spacing_m, 1.5F * typical_pitch_m({sparse}), 1e-6F);
  EXPECT_GT(learned_surface({sparse}).spacing_m, 0.004F);
  EXPECT_GT(learned_surface({sparse}).mesh.triangles.size(), 100U);
  SeenPoints plank{{}, Vector3f::UnitZ()};
  for (int i = 0; i <= 480; ++i) {
    for (int j = 0; j < 12; ++j) {
      plank.points.emplace_back(0.0025F * static_cast<float>(i), 0.0025F * static_cast<float>(j),
                                0.0F);
    }
  }
  EXPECT_NEAR(learned_surface({plank}).spacing_m, 1.2F / 120.0F, 1e-6F);
}

TEST(LearnedSurface, OfNothingIsNothing) {
  EXPECT_TRUE(learned_surface({}).mesh.triangles.empty());
  EXPECT_TRUE(learned_surface({SeenPoints{}, SeenPoints{}}).mesh.triangles.empty());
  SeenPoints const few{{{0, 0, 1}, {0.001F, 0, 1}}, Vector3f::Zero()};
  EXPECT_TRUE(learned_surface({few}).mesh.triangles.empty());
  EXPECT_EQ(learned_surface({few}).points, 2U);
}

}  // namespace
}  // namespace credo::test
