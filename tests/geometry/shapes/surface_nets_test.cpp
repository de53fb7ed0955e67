// Surfaces through points whose true shape is known, and the grid's distances against sums over all
// points.
#include "geometry/shapes/surface_nets.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/shapes/mesh_edges.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;
using Points = std::vector<OrientedPoint>;

constexpr float kSpacing_m = 0.004F;
constexpr float kRadius_m = 0.05F;

/// Evenly over a sphere (a Fibonacci spiral), outward, as far as z is above a height.
Points sphere(float least_z_m = -1.0F, int count = 12000) {
  Points points;
  for (int i = 0; i < count; ++i) {
    float const z = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    float const turn = 2.39996323F * static_cast<float>(i);
    float const across = std::sqrt(1.0F - z * z);
    Vector3f const normal(across * std::cos(turn), across * std::sin(turn), z);
    if (kRadius_m * z >= least_z_m) {
      points.push_back({kRadius_m * normal, normal});
    }
  }
  return points;
}

/// A square sheet about (x, 0, z), every 2 mm.
Points sheet(float x_m, float z_m, float half_m, Vector3f const& normal) {
  Points points;
  for (float x = -half_m; x <= half_m; x += 0.002F) {
    for (float y = -half_m; y <= half_m; y += 0.002F) {
      points.push_back({{x_m + x, y, z_m}, normal});
    }
  }
  return points;
}

Points joined(Points a, Points const& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double area_m2(TriangleMesh const& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += area_vector(mesh, t).norm() / 2.0;
  }
  return sum;
}

/// Share of the surface that faces away from a point inside.
double outward_share(TriangleMesh const& mesh, Vector3f const& inside) {
  double outward = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Vector3f const corner = mesh.vertices[mesh.triangles[t][0]];
    bool const out = area_vector(mesh, t).dot((corner - inside).cast<double>()) > 0.0;
    outward += out ? area_vector(mesh, t).norm() / 2.0 : 0.0;
  }
  return outward / area_m2(mesh);
}

TEST(SurfaceNets, ASphereSeenAllAroundIsClosed) {
  TriangleMesh const mesh = surface_through(sphere(), kSpacing_m);
  EXPECT_TRUE(is_closed(edges_of(mesh)));
  for (Vector3f const& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.norm(), kRadius_m, 0.15F * kSpacing_m);
  }
  double const truth_m2 =
      4.0 * std::numbers::pi * static_cast<double>(kRadius_m) * static_cast<double>(kRadius_m);
  EXPECT_NEAR(area_m2(mesh) / truth_m2, 1.0, 0.02);
  EXPECT_GT(outward_share(mesh, Vector3f::Zero()), 0.9999);
}

TEST(SurfaceNets, WhereNothingWasSeenItIsOpen) {
  TriangleMesh const mesh = surface_through(sphere(0.0F), kSpacing_m);
  EXPECT_FALSE(is_closed(edges_of(mesh)));
  float lowest_m = 1.0F;
  for (Vector3f const& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.norm(), kRadius_m, 0.15F * kSpacing_m);
    lowest_m = std::min(lowest_m, vertex.z());
  }
  EXPECT_GT(lowest_m, -kSpacing_m) << "it grows over the border";
  EXPECT_LT(lowest_m, kSpacing_m) << "it ends before the border";
  EXPECT_GT(outward_share(mesh, Vector3f::Zero()), 0.9999);
}

TEST(SurfaceNets, AThinWallHasTwoSides) {
  constexpr float kHalfWall_m = 0.0025F;  // either side is well in reach of the other
  Points const wall = joined(sheet(0, kHalfWall_m, 0.03F, Vector3f::UnitZ()),
                             sheet(0, -kHalfWall_m, 0.03F, -Vector3f::UnitZ()));
  TriangleMesh const mesh = surface_through(wall, kSpacing_m);
  for (Vector3f const& vertex : mesh.vertices) {
    EXPECT_NEAR(std::abs(vertex.z()), kHalfWall_m, 1e-5F);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_GT(
        area_vector(mesh, t).z() * static_cast<double>(mesh.vertices[mesh.triangles[t][0]].z()),
        0.0);
  }
  EXPECT_NEAR(area_m2(mesh), 2.0 * 0.06 * 0.06, 2.0 * 4.0 * 0.06 * 0.004);
}

TEST(SurfaceNets, NoiseAveragesOut) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise_m(0.0F, 0.001F);
  Points points;
  for (int look = 0; look < 4; ++look) {
    points = joined(std::move(points), sheet(0, 0, 0.04F, Vector3f::UnitZ()));
  }
  for (OrientedPoint& p : points) {
    p.point.z() += noise_m(random);
  }
  float squares = 0.0F;
  TriangleMesh const mesh = surface_through(points, kSpacing_m);
  ASSERT_GT(mesh.vertices.size(), 200U);
  for (Vector3f const& vertex : mesh.vertices) {
    squares += vertex.z() * vertex.z();
  }
  EXPECT_LT(std::sqrt(squares / static_cast<float>(mesh.vertices.size())), 0.00025F);
}

TEST(SurfaceNets, CrumbsAreLeftOutAndPartsAreNot) {
  Points const large = sheet(0, 0, 0.04F, Vector3f::UnitZ());
  auto const farthest_x = [](Points const& points) {
    float most_m = 0.0F;
    for (Vector3f const& vertex : surface_through(points, kSpacing_m).vertices) {
      most_m = std::max(most_m, vertex.x());
    }
    return most_m;
  };
  EXPECT_GT(farthest_x(joined(large, sheet(0.1F, 0, 0.02F, Vector3f::UnitZ()))), 0.1F);
  EXPECT_LT(farthest_x(joined(large, sheet(0.1F, 0, 0.005F, Vector3f::UnitZ()))), 0.05F);
}

TEST(SurfaceNets, WithoutPointsThereIsNone) {
  EXPECT_TRUE(surface_through({}, kSpacing_m).vertices.empty());
}

TEST(SurfaceNets, APointHasNoMoreThanASpacingAroundIt) {
  Points const one = {{{0.1F, 0.2F, 0.3F}, Vector3f::UnitX()}};
  for (Vector3f const& vertex : surface_through(one, kSpacing_m).vertices) {
    EXPECT_LE((vertex - one[0].point).norm(), 1.0001F * kSpacing_m);
  }
}

// The twin: distances at corners by asking all points, cells one by one.

struct LiteralCorner {
  bool known = false;
  float distance_m = 0.0F;
};

LiteralCorner literal_corner(Points const& points, Vector3f const& at) {
  constexpr float kReach_m = 2.0F * kSpacing_m;
  OrientedPoint const& nearest = *std::ranges::min_element(
      points, {}, [&](OrientedPoint const& p) { return (at - p.point).squaredNorm(); });
  float weights = 0.0F;
  float sum = 0.0F;
  for (OrientedPoint const& p : points) {
    Vector3f const offset = at - p.point;
    float const left = 1.0F - offset.squaredNorm() / (kReach_m * kReach_m);
    if (left > 0.0F && p.normal.dot(nearest.normal) > 0.5F) {
      weights += left * left;
      sum += left * left * p.normal.dot(offset);
    }
  }
  return {weights > 0.0F, weights > 0.0F ? sum / weights : 0.0F};
}

/// The vertices of all cells, sorted.
std::vector<std::array<float, 3>> literal_vertices(Points const& points) {
  Eigen::AlignedBox3f bounds;
  for (OrientedPoint const& p : points) {
    bounds.extend(p.point);
  }
  Vector3f const origin = bounds.min() - Vector3f::Constant(3.0F * kSpacing_m);
  Eigen::Array3i const cells =
      ((bounds.max() + Vector3f::Constant(3.0F * kSpacing_m) - origin) / kSpacing_m)
          .array()
          .ceil()
          .cast<int>();
  std::vector<std::array<float, 3>> vertices;
  for (int x = 0; x < cells.x(); ++x) {
    for (int y = 0; y < cells.y(); ++y) {
      for (int z = 0; z < cells.z(); ++z) {
        std::array<LiteralCorner, 8> corners;
        std::array<Vector3f, 8> at;
        bool known = true;
        for (int k = 0; k < 8; ++k) {
          auto const i = static_cast<std::size_t>(k);
          at[i] = origin +
                  kSpacing_m *
                      Eigen::Vector3i(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)).cast<float>();
          corners[i] = literal_corner(points, at[i]);
          known = known && corners[i].known;
        }
        Vector3f sum = Vector3f::Zero();
        float cuts = 0.0F;
        for (auto const& [a, b] : {std::pair(0U, 1U),
                                   {2U, 3U},
                                   {4U, 5U},
                                   {6U, 7U},  // along x
                                   {0U, 2U},
                                   {1U, 3U},
                                   {4U, 6U},
                                   {5U, 7U},  // y
                                   {0U, 4U},
                                   {1U, 5U},
                                   {2U, 6U},
                                   {3U, 7U}}) {  // z
          float const da = corners[a].distance_m;
          float const db = corners[b].distance_m;
          if ((da < 0.0F) != (db < 0.0F)) {
            sum += at[a] + da / (da - db) * (at[b] - at[a]);
            cuts += 1.0F;
          }
        }
        Vector3f const vertex = sum / std::max(cuts, 1.0F);
        bool const seen = std::ranges::any_of(points, [&](OrientedPoint const& p) {
          return (p.point - vertex).norm() <= kSpacing_m;
        });
        if (known && cuts > 0.0F && seen) {
          vertices.push_back({vertex.x(), vertex.y(), vertex.z()});
        }
      }
    }
  }
  std::ranges::sort(vertices);
  return vertices;
}

TEST(SurfaceNets, VerticesAreThoseOfTheDefinition) {
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0.0F, 0.0005F);
  Points points = sphere(0.02F, 4000);
  for (OrientedPoint& p : points) {
    p.point += Vector3f(noise(random), noise(random), noise(random));
    p.normal = (p.normal + 200.0F * Vector3f(noise(random), noise(random), 0.0F)).normalized();
  }
  std::vector<std::array<float, 3>> const literal = literal_vertices(points);
  TriangleMesh const mesh = surface_through(points, kSpacing_m);
  // A vertex at the border may have no face; all others are there.
  EXPECT_GT(mesh.vertices.size(), 0.9 * static_cast<double>(literal.size()));
  for (Vector3f const& vertex : mesh.vertices) {
    bool const known = std::ranges::any_of(literal, [&](std::array<float, 3> const& one) {
      return (Vector3f(one[0], one[1], one[2]) - vertex).norm() < 1e-5F;
    });
    EXPECT_TRUE(known) << vertex.transpose();
  }
}

}  // namespace
}  // namespace credo::test
