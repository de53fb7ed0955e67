// Rendered depth against a ray through each pixel, tried on every triangle.
#include "geometry/depth_patch.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "geometry/shapes/triangle.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr CameraIntrinsics kCamera{60.0, 58.0, 31.5, 23.5};
constexpr ImageSize kSize{64, 48};
constexpr double kNearest_m = 0.01;

struct Mesh {
  std::vector<Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  void add(Vector3f const& a, Vector3f const& b, Vector3f const& c) {
    auto const first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
  }
};

DepthPatch rendered(Mesh const& mesh, ImageSize size = kSize) {
  return render_depth(mesh.vertices, mesh.triangles, kCamera, size);
}

/// Depth of a pixel of the image, wherever the patch lies.
double depth_at(DepthPatch const& patch, int u, int v) {
  Pixel const in_patch{u - patch.corner.u, v - patch.corner.v};
  return patch.depth_m.contains(in_patch) ? static_cast<double>(patch.depth_m[in_patch])
                                          : std::numeric_limits<double>::infinity();
}

double literal_depth(Mesh const& mesh, double u, double v) {
  Vector3d const ray((u - kCamera.cx_px) / kCamera.fx_px, (v - kCamera.cy_px) / kCamera.fy_px, 1.0);
  double nearest = std::numeric_limits<double>::infinity();
  for (auto const& [a, b, c] : mesh.triangles) {
    std::array<Vector3d, 3> const corners = {mesh.vertices[a].cast<double>(),
                                             mesh.vertices[b].cast<double>(),
                                             mesh.vertices[c].cast<double>()};
    bool const before = std::ranges::all_of(
        corners, [](Vector3d const& corner) { return corner.z() >= kNearest_m; });
    if (auto const hit = distance_to_triangle(corners, Vector3d::Zero(), ray); before && hit) {
      nearest = std::min(nearest, *hit);
    }
  }
  return nearest;
}

/// What rays a little beside a pixel's centre see, where all see about the same.
struct Literal {
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -std::numeric_limits<double>::infinity();
  [[nodiscard]] bool certain() const {
    return (std::isinf(low_m) && std::isinf(high_m)) || high_m - low_m < 0.1 * low_m;
  }
};
Literal literal_at(Mesh const& mesh, int u, int v) {
  constexpr double kBeside_px = 0.08;
  Literal seen;
  for (double const du : {-kBeside_px, 0.0, kBeside_px}) {
    for (double const dv : {-kBeside_px, 0.0, kBeside_px}) {
      double const depth_m = literal_depth(mesh, u + du, v + dv);
      seen.low_m = std::min(seen.low_m, depth_m);
      seen.high_m = std::max(seen.high_m, depth_m);
    }
  }
  return seen;
}

/// Compares all pixels that are certain; how many of them show a surface.
int expect_equal(Mesh const& mesh, DepthPatch const& patch) {
  int hits = 0;
  for (int v = 0; v < kSize.height_px; ++v) {
    for (int u = 0; u < kSize.width_px; ++u) {
      Literal const literal = literal_at(mesh, u, v);
      if (!literal.certain()) {
        continue;
      }
      double const depth_m = depth_at(patch, u, v);
      if (std::isinf(literal.low_m)) {
        EXPECT_TRUE(std::isinf(depth_m)) << u << ' ' << v << ' ' << depth_m;
        continue;
      }
      ++hits;
      EXPECT_GE(depth_m, literal.low_m * (1 - 1e-4)) << u << ' ' << v;
      EXPECT_LE(depth_m, literal.high_m * (1 + 1e-4)) << u << ' ' << v;
    }
  }
  return hits;
}

Mesh random_triangles(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> aside(-1.2F, 1.2F);
  std::uniform_real_distribution<float> ahead(0.0F, 3.0F);
  Mesh mesh;
  for (int i = 0; i < 12; ++i) {
    auto const corner = [&] {
      // Or behind: what is very near is so large that rounding moves its borders.
      float const z = ahead(random);
      return Vector3f(aside(random), aside(random), z < 0.3F ? -0.1F : z);
    };
    mesh.add(corner(), corner(), corner());
  }
  return mesh;
}

class RandomTriangles : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomTriangles, AreAsDeepAsTheirRays) {
  Mesh const mesh = random_triangles(GetParam());
  EXPECT_GT(expect_equal(mesh, rendered(mesh)), 500);
}

TEST_P(RandomTriangles, AreTheSameToTheBitOnEveryInstructionSet) {
  Mesh const mesh = random_triangles(GetParam());
  DepthPatch const expected = rendered(mesh);
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    DepthPatch const patch = rendered(mesh);
    EXPECT_EQ(patch.corner, expected.corner);
    EXPECT_TRUE(std::ranges::equal(patch.depth_m, expected.depth_m));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTriangles, ::testing::Values(1U, 2U, 3U, 4U, 5U, 6U));

TEST(DepthPatch, IsAsLargeAsWhatIsSeen) {
  Mesh mesh;
  // Corners at the pixels (10.5, 5.5), (20, 5.5) and (10.5, 15).
  auto const at = [](double u, double v) {
    return Vector3f(Vector3d((u - kCamera.cx_px) / kCamera.fx_px * 2,
                             (v - kCamera.cy_px) / kCamera.fy_px * 2, 2)
                        .cast<float>());
  };
  mesh.add(at(10.5, 5.5), at(20.2, 5.5), at(10.5, 15.2));
  DepthPatch const patch = rendered(mesh);
  EXPECT_EQ(patch.corner, (Pixel{11, 6}));
  EXPECT_EQ(patch.depth_m.width(), 10);
  EXPECT_EQ(patch.depth_m.height(), 10);
  EXPECT_FLOAT_EQ(patch.depth_m[Pixel(0, 0)], 2.0F);
  EXPECT_EQ(patch.depth_m[Pixel(9, 9)], kNoSurface_m) << "beyond the longest side";
}

TEST(DepthPatch, IsCutAtTheImage) {
  for (auto const& [x, y] : {std::array{-1.1F, 0.0F}, std::array{1.1F, 0.0F},
                             std::array{0.0F, -0.8F}, std::array{0.0F, 0.8F}}) {
    Mesh mesh;
    mesh.add({x - 0.4F, y - 0.4F, 2}, {x + 0.4F, y - 0.4F, 2}, {x, y + 0.5F, 2});
    DepthPatch const patch = rendered(mesh);
    EXPECT_GE(patch.corner.u, 0);
    EXPECT_GE(patch.corner.v, 0);
    EXPECT_LE(patch.corner.u + patch.depth_m.width(), kSize.width_px);
    EXPECT_LE(patch.corner.v + patch.depth_m.height(), kSize.height_px);
    EXPECT_GT(expect_equal(mesh, patch), 20) << x << ' ' << y;
  }
}

TEST(DepthPatch, OutsideOfTheImageThereIsNone) {
  for (Vector3f const& place : {Vector3f(-5, 0, 2), Vector3f(5, 0, 2), Vector3f(0, -5, 2),
                                Vector3f(0, 5, 2), Vector3f(0, 0, -2)}) {
    Mesh mesh;
    mesh.add(place, place + Vector3f(0.3F, 0, 0), place + Vector3f(0, 0.3F, 0));
    EXPECT_TRUE(rendered(mesh).depth_m.empty()) << place.transpose();
  }
  EXPECT_TRUE(rendered(Mesh{}).depth_m.empty());
}

TEST(DepthPatch, ATriangleWithACornerTooNearIsLeftOut) {
  Mesh mesh;
  mesh.add({-0.5F, -0.5F, 1}, {0.5F, -0.5F, 1}, {0, 0.5F, 0.009F});
  mesh.add({-0.5F, -0.5F, 1}, {0.5F, -0.5F, 1}, {0, 0.5F, -1});
  for (float const depth_m : rendered(mesh).depth_m) {
    EXPECT_EQ(depth_m, kNoSurface_m);
  }
  mesh.add({-0.5F, -0.5F, 3}, {0.5F, -0.5F, 3}, {0, 0.5F, 3});
  DepthPatch const patch = rendered(mesh);
  EXPECT_NEAR(depth_at(patch, 31, 22), 3.0, 1e-5) << "others are drawn nevertheless";
  EXPECT_GT(expect_equal(mesh, patch), 50);
}

TEST(DepthPatch, AHugeTriangleFillsTheImage) {
  Mesh mesh;
  mesh.add({-200, -200, 2}, {200, -200, 2}, {0, 300, 2});
  DepthPatch const patch = rendered(mesh);
  ASSERT_EQ(patch.depth_m.width(), kSize.width_px);
  ASSERT_EQ(patch.depth_m.height(), kSize.height_px);
  for (float const depth_m : patch.depth_m) {
    EXPECT_NEAR(depth_m, 2.0F, 2e-3F);
  }
}

TEST(DepthPatch, LooksTheSameFromItsBack) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> number(-1, 1);
  Mesh front;
  Mesh back;
  for (int i = 0; i < 8; ++i) {
    auto const corner = [&] {
      return Vector3f(number(random), number(random), 2 + number(random));
    };
    Vector3f const a = corner();
    Vector3f const b = corner();
    Vector3f const c = corner();
    front.add(a, b, c);
    back.add(a, c, b);
  }
  DepthPatch const one = rendered(front);
  DepthPatch const other = rendered(back);
  ASSERT_EQ(one.corner, other.corner);
  ASSERT_TRUE(one.depth_m.same_size(other.depth_m));
  EXPECT_GT(expect_equal(back, other), 100);
}

TEST(DepthPatch, ATriangleWithoutAnAreaIsNotSeen) {
  Mesh mesh;
  mesh.add({-0.5F, 0, 1}, {0.5F, 0, 1}, {0, 0, 1});
  mesh.add({-0.5F, -0.5F, 1}, {-0.5F, -0.5F, 1}, {0.5F, 0.5F, 1});
  for (float const depth_m : rendered(mesh).depth_m) {
    EXPECT_TRUE(depth_m == kNoSurface_m || std::abs(depth_m - 1.0F) < 1e-3F) << depth_m;
  }
}

/// A sheet of shared corners over all of the image, turned and waved.
Mesh sheet(unsigned seed, bool on_pixels) {
  constexpr std::uint32_t kCells = 9;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-0.4, 0.4);
  Mesh mesh;
  for (std::uint32_t row = 0; row <= kCells; ++row) {
    for (std::uint32_t column = 0; column <= kCells; ++column) {
      double const u = -4.0 + 8.0 * column + (on_pixels ? 0.0 : number(random));
      double const v = -4.0 + 6.0 * row + (on_pixels ? 0.0 : number(random));
      double const z = 2.0 + number(random);
      mesh.vertices.emplace_back(Vector3d((u - kCamera.cx_px) / kCamera.fx_px * z,
                                          (v - kCamera.cy_px) / kCamera.fy_px * z, z)
                                     .cast<float>());
    }
  }
  for (std::uint32_t row = 0; row < kCells; ++row) {
    for (std::uint32_t column = 0; column < kCells; ++column) {
      std::uint32_t const corner = row * (kCells + 1) + column;
      mesh.triangles.push_back({corner, corner + 1, corner + kCells + 1});
      mesh.triangles.push_back({corner + 1, corner + kCells + 2, corner + kCells + 1});
    }
  }
  return mesh;
}

TEST(DepthPatch, NeighboursLeaveNoCracks) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    for (bool const on_pixels : {false, true}) {
      Mesh const mesh = sheet(seed, on_pixels);
      DepthPatch const patch = rendered(mesh);
      for (int v = 0; v < 46; ++v) {
        for (int u = 0; u < 64; ++u) {
          double const depth_m = depth_at(patch, u, v);
          ASSERT_TRUE(depth_m > 1.5 && depth_m < 2.5) << seed << ' ' << u << ' ' << v;
        }
      }
    }
  }
}

TEST(DepthPatch, TheNearestIsSeen) {
  Mesh mesh;
  for (float const z : {2.0F, 1.0F, 3.0F}) {
    mesh.add({-3, -3, z}, {3, -3, z}, {0, 3, z});
  }
  EXPECT_NEAR(depth_at(rendered(mesh), 31, 23), 1.0, 1e-5);
}

TEST(DepthPatch, WhatFacesTheCameraTurnsCounterClockwise) {
  // Beside the axis a triangle may face the camera and yet lean away from the image's plane.
  Mesh mesh;
  mesh.add({-0.1F, 0.1F, 1.0F}, {0.1F, 0.1F, 1.0F}, {0.0F, -0.1F, 1.0F});  // y is down
  mesh.add({0.1F, 0.1F, 1.0F}, {-0.1F, 0.1F, 1.0F}, {0.0F, -0.1F, 1.0F});
  mesh.add({1.0F, -0.1F, 1.0F}, {1.0F, 0.1F, 1.0F}, {1.1F, 0.0F, 1.5F});
  mesh.add({1.0F, 0.1F, 1.0F}, {1.0F, -0.1F, 1.0F}, {1.1F, 0.0F, 1.5F});
  auto const facing = facing_camera(mesh.vertices, mesh.triangles);
  ASSERT_EQ(facing.size(), 2U);
  for (auto const& [a, b, c] : facing) {
    // The literal test: along the ray to a corner the normal comes back.
    Vector3f const normal =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    EXPECT_LT(normal.dot(mesh.vertices[c]), 0.0F);
  }
  EXPECT_EQ(facing[0], mesh.triangles[0]);
  EXPECT_EQ(facing[1][0] / 3, 3U);
}

}  // namespace
}  // namespace credo::test
