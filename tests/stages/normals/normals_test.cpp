#include "stages/normals/normals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/rendered_scene.hpp"

namespace credo {
namespace {

using test::kinect_intrinsics;

NormalMap normals_of(Grid<float> const& depth_m, NormalsConfig const& config = {}) {
  return estimate_normals(cloud_from_depth(depth_m, kinect_intrinsics()), kinect_intrinsics(),
                          config);
}

std::size_t valid_count(NormalMap const& normals) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    count += normals.valid(i) ? 1 : 0;
  }
  return count;
}

/// All components, bit by bit: NaN is equal to NaN.
std::vector<std::uint32_t> bits_of(NormalMap const& normals) {
  std::vector<std::uint32_t> bits;
  for (Grid<float> const* component : {&normals.x, &normals.y, &normals.z}) {
    for (float const value : *component) {
      bits.push_back(std::bit_cast<std::uint32_t>(value));
    }
  }
  return bits;
}

/// An odd size, so that half blocks and part-filled vectors are met.
Grid<float> noisy_room() {
  auto const room = test::render(test::room_scene(), 637, 475, kinect_intrinsics());
  return test::with_kinect_noise(room.depth_m, 7);
}

TEST(Normals, AreUnitAndFaceTheCamera) {
  OrganizedCloud const cloud = cloud_from_depth(noisy_room(), kinect_intrinsics());
  NormalMap const normals = estimate_normals(cloud, kinect_intrinsics(), {});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (normals.valid(i)) {
      ASSERT_TRUE(cloud.valid(i));
      ASSERT_NEAR(normals.at(i).norm(), 1.0F, 1e-6F);
      ASSERT_LE(normals.at(i).dot(cloud.at(i)), 0.0F);
    } else {
      ASSERT_TRUE(std::isnan(normals.x[i]) && std::isnan(normals.y[i]) && std::isnan(normals.z[i]));
    }
  }
  EXPECT_GT(valid_count(normals), cloud.size() / 2);
}

TEST(Normals, AreTheSameToTheBitOnEveryInstructionSet) {
  Grid<float> const depth_m = noisy_room();
  auto const best = bits_of(normals_of(depth_m));
  std::int64_t const supported = hwy::SupportedTargets();
  int compared = 0;
  for (std::int64_t targets = supported; targets != 0; targets &= targets - 1) {
    std::int64_t const target = targets & -targets;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_EQ(bits_of(normals_of(depth_m)), best) << hwy::TargetName(target);
    ++compared;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GE(compared, 1);
}

TEST(Normals, AreTheSameToTheBitOnAnyNumberOfThreads) {
  Grid<float> const depth_m = noisy_room();
  std::set<std::vector<std::uint32_t>> results;
  for (std::size_t const threads : {1, 2, 5}) {
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, threads);
    results.insert(bits_of(normals_of(depth_m)));
  }
  EXPECT_EQ(results.size(), 1);
}

TEST(Normals, TurnWithTheSceneMirrored) {
  // Left and right exchanged: blocks pair up the same way on an even width with a centred camera.
  Grid<float> const depth_m =
      test::render(test::room_scene(), 640, 480, kinect_intrinsics()).depth_m;
  Grid<float> mirrored(640, 480);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    Pixel const p = depth_m.pixel(i);
    mirrored[Pixel{639 - p.u, p.v}] = depth_m[i];
  }
  NormalMap const normals = normals_of(depth_m);
  NormalMap const turned = normals_of(mirrored);
  // Means over an even number of blocks are not centred: beside creases and jumps the mirrored
  // window holds other samples (1.7 % of the pixels here). All others agree.
  std::size_t apart = 0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    Pixel const p = depth_m.pixel(i);
    Eigen::Vector3f const back =
        turned.at(Pixel{639 - p.u, p.v}).cwiseProduct(Eigen::Vector3f(-1.0F, 1.0F, 1.0F));
    bool const both = normals.valid(i) && turned.valid(turned.x.index({639 - p.u, p.v}));
    apart += both && (back - normals.at(i)).norm() > 0.1F ? 1 : 0;
  }
  EXPECT_LT(apart, depth_m.size() / 40);
}

TEST(Normals, OfAnEmptyCloudAreEmpty) {
  EXPECT_TRUE(normals_of(Grid<float>()).empty());
}

TEST(Normals, AreNaNWhereAPixelStandsAlone) {
  EXPECT_EQ(valid_count(normals_of(Grid<float>(1, 1, 1.0F))), 0);
  EXPECT_EQ(valid_count(normals_of(Grid<float>(64, 1, 1.0F))), 0) << "a row carries no plane";
  EXPECT_EQ(valid_count(normals_of(Grid<float>(1, 64, 1.0F))), 0) << "a column carries no plane";
  Grid<float> alone(64, 48, 0.0F);
  alone[Pixel{20, 20}] = 1.0F;
  EXPECT_EQ(valid_count(normals_of(alone)), 0);
}

TEST(Normals, AreNaNWithoutValidDepth) {
  float const infinite = std::numeric_limits<float>::infinity();
  for (float const depth_m : {0.0F, -1.0F, kNaN, infinite, 1e-20F, 1e20F}) {
    EXPECT_EQ(valid_count(normals_of(Grid<float>(33, 17, depth_m))), 0) << depth_m;
  }
}

TEST(Normals, OfConstantDepthFaceTheCameraEverywhere) {
  for (float const depth_m : {0.01F, 0.2F, 0.5F, 1.0F, 3.0F, 10.0F, 1000.0F}) {
    NormalMap const normals = normals_of(Grid<float>(91, 71, depth_m));
    for (std::size_t i = 0; i < normals.size(); ++i) {
      ASSERT_EQ(normals.at(i), Eigen::Vector3f(0.0F, 0.0F, -1.0F)) << depth_m;
    }
  }
}

TEST(Normals, DoNotReachAcrossADepthJump) {
  // Two walls that face the camera, 10 cm apart: every pixel of both is exact, up to the edge and
  // whether the edge falls between blocks or inside them.
  for (int const edge : {32, 33}) {
    Grid<float> depth_m(64, 64, 1.1F);
    for (int v = 0; v < 64; ++v) {
      for (int u = 0; u < edge; ++u) {
        depth_m[Pixel{u, v}] = 1.0F;
      }
    }
    NormalMap const normals = normals_of(depth_m);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      ASSERT_EQ(normals.at(i), Eigen::Vector3f(0.0F, 0.0F, -1.0F));
    }
  }
}

TEST(Normals, OfAPlaneAreGoodBesideHoles) {
  Eigen::Vector3d const normal = Eigen::Vector3d(0.3, -0.5, -1.0).normalized();
  test::Scene const scene{{{normal, normal.z() * 1.2}}, {}, {}};
  Grid<float> depth_m = test::render(scene, 160, 120, kinect_intrinsics()).depth_m;
  for (int v = 40; v < 60; ++v) {
    for (int u = 60; u < 90; ++u) {
      depth_m[Pixel{u, v}] = 0.0F;
    }
  }
  NormalMap const normals = normals_of(depth_m);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    ASSERT_EQ(normals.valid(i), depth_m[i] > 0.0F);
    if (normals.valid(i)) {
      // At 1.2 m a sample is the mean over 2x2 blocks: one half over the hole stands for a place a
      // pixel aside, in a window that reaches 14.
      ASSERT_LT((normals.at(i) - normal.cast<float>()).norm(), 0.04F);
    }
  }
}

TEST(Normals, RefuseACameraWithoutFocalLength) {
  OrganizedCloud const cloud = cloud_from_depth(Grid<float>(8, 8, 1.0F), kinect_intrinsics());
  EXPECT_THROW(estimate_normals(cloud, {0.0, 585.0, 4.0, 4.0}, {}), std::logic_error);
  EXPECT_THROW(estimate_normals(cloud, {585.0, std::nan(""), 4.0, 4.0}, {}), std::logic_error);
}

TEST(NormalsConfig, DescribesEveryMemberOnce) {
  NormalsConfig config;
  std::set<void const*> members;
  for (Field const& field : fields(config)) {
    auto* const* const member = std::get_if<float*>(&field.target);
    ASSERT_NE(member, nullptr) << field.name;
    members.insert(*member);
    EXPECT_GE(**member, static_cast<float>(field.range.min)) << field.name;
    EXPECT_LE(**member, static_cast<float>(field.range.max)) << field.name;
    EXPECT_FALSE(field.text.empty()) << field.name;
  }
  EXPECT_EQ(members.size() * sizeof(float), sizeof(NormalsConfig));
}

}  // namespace
}  // namespace credo
