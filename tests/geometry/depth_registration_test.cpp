#include "geometry/depth_registration.hpp"

#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "core/cloud.hpp"
#include "support/literal_registration.hpp"

namespace credo {
namespace {

using test::literal_registration;

/// 64 x 48: small enough for the literal one.
DepthCalibration small_calibration() {
  return scaled(kinect_calibration(), 0.1);
}

DepthCalibration turned_calibration() {
  DepthCalibration calibration = small_calibration();
  calibration.T_color_depth =
      Se3(Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Eigen::Vector3d(0.5, -0.4, 1.0).normalized())),
          {-0.025, 0.004, 0.01});
  return calibration;
}

/// A slanted wall with a box before it, the shadow of the box, and single pixels without depth.
Grid<float> cluttered_depth(int width, int height, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> chance(0.0F, 1.0F);
  Grid<float> depth_m(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      bool const in_rows = v > height / 4 && v < 3 * height / 4;
      float z = 1.5F + 0.02F * static_cast<float>(u) + 0.01F * static_cast<float>(v);
      z = in_rows && u > width / 3 && u < width / 2 ? 0.6F : z;
      z = in_rows && u > width / 4 && u <= width / 3 ? 0.0F : z;
      depth_m[Pixel{u, v}] = chance(engine) < 0.05F ? kNaN : z + 0.01F * chance(engine);
    }
  }
  return depth_m;
}

void expect_same(Grid<float> const& found, Grid<float> const& expected) {
  ASSERT_TRUE(found.same_size(expected));
  for (std::size_t i = 0; i < found.size(); ++i) {
    Pixel const p = found.pixel(i);
    ASSERT_NEAR(found[i], expected[i], 2e-6F * expected[i]) << "at " << p.u << " " << p.v;
  }
}

TEST(DepthRegistration, IsTheLiteralOne) {
  for (unsigned const seed : {1U, 2U, 3U}) {
    for (DepthCalibration const& calibration : {small_calibration(), turned_calibration()}) {
      Grid<float> const depth_m = cluttered_depth(64, 48, seed);
      expect_same(register_depth(depth_m, calibration, 64, 48),
                  literal_registration(depth_m, calibration, 64, 48));
    }
  }
}

TEST(DepthRegistration, IsTheLiteralOneBetweenSizesThatDiffer) {
  DepthCalibration calibration = turned_calibration();
  // A colour camera twice as fine: each depth pixel covers several.
  calibration.color = scaled(calibration, 2.0).color;
  Grid<float> const depth_m = cluttered_depth(61, 47, 5);
  expect_same(register_depth(depth_m, calibration, 130, 90),
              literal_registration(depth_m, calibration, 130, 90));
  calibration.color = scaled(calibration, 0.2).color;
  expect_same(register_depth(depth_m, calibration, 25, 20),
              literal_registration(depth_m, calibration, 25, 20));
}

// Every instruction set that this machine can run, from the plainest to the widest.
TEST(DepthRegistration, IsTheSameOnEveryInstructionSet) {
  Grid<float> const depth_m = cluttered_depth(61, 47, 7);
  std::vector<Grid<float>> results;
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    results.push_back(register_depth(depth_m, turned_calibration(), 64, 48));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GT(results.size(), 1U);
  EXPECT_THAT(results, testing::Each(results.front()));
}

TEST(DepthRegistration, OfAPlaneLeavesNoHoles) {
  for (double const fineness : {1.0, 1.3, 2.5}) {
    for (float const slope : {-0.012F, 0.0F, 0.012F}) {
      DepthCalibration calibration = kinect_calibration();
      calibration.color.fx_px *= fineness;
      calibration.color.fy_px *= fineness;
      Grid<float> depth_m(640, 480);
      for (std::size_t i = 0; i < depth_m.size(); ++i) {
        Pixel const p = depth_m.pixel(i);
        float const ray = static_cast<float>(p.u - 320) / 575.8F;
        // Up to 55 degrees between its normal and the optical axis.
        depth_m[i] = 1.5F / (1.0F + 120.0F * slope * ray + static_cast<float>(p.v) / 2000.0F);
      }
      Grid<float> const registered_m = register_depth(depth_m, calibration, 640, 480);
      for (int v = 40; v < 440; ++v) {
        for (int u = 60; u < 580; ++u) {
          ASSERT_GT(registered_m[(Pixel{u, v})], 0.0F) << u << " " << v << " " << slope;
        }
      }
    }
  }
}

TEST(DepthRegistration, OfATurnedCameraLeavesNoHoles) {
  DepthCalibration calibration = scaled(turned_calibration(), 10.0);
  for (double const turn_rad : {0.002, 0.01, 0.05}) {
    calibration.T_color_depth =
        Se3(so3_exp(turn_rad * Eigen::Vector3d(0.5, -0.4, 1.0).normalized()), {-0.025, 0.0, 0.0});
    Grid<float> const registered_m =
        register_depth(Grid<float>(640, 480, 1.2F), calibration, 640, 480);
    for (int v = 60; v < 420; ++v) {
      for (int u = 60; u < 580; ++u) {
        ASSERT_GT(registered_m[(Pixel{u, v})], 0.0F) << u << " " << v;
      }
    }
  }
}

// Near things move to the left by focal length x baseline / depth, far ones by less.
TEST(DepthRegistration, ShiftsByTheBaseline) {
  Grid<float> depth_m(640, 480, 0.0F);
  depth_m[Pixel{320, 240}] = 0.5F;
  depth_m[Pixel{320, 100}] = 5.0F;
  Grid<float> const registered_m = register_depth(depth_m, kinect_calibration(), 640, 480);
  EXPECT_EQ(registered_m[(Pixel{294, 240})], 0.5F);  // 319.5 + 0.5 * 525 / 575.8 - 26.25
  EXPECT_EQ(registered_m[(Pixel{317, 112})], 5.0F);  // 319.96 - 2.6, 239.5 - 139.5 * 0.912
}

// A foreground before a wall: what it hides from the colour camera does not shine through, and what
// only the colour camera sees is empty.
TEST(DepthRegistration, HidesWhatLiesBehind) {
  Grid<float> depth_m(640, 480, 2.0F);
  for (int v = 0; v < 480; ++v) {
    for (int u = 300; u < 400; ++u) {
      depth_m[Pixel{u, v}] = 0.8F;
    }
  }
  Grid<float> const registered_m = register_depth(depth_m, kinect_calibration(), 640, 480);
  auto const column = [](double u, double z) {
    return (u - 319.5) * 525.0 / 575.8 + 319.5 - 525.0 * 0.025 / z;
  };
  for (int u = 100; u < 600; ++u) {
    float const z = registered_m[(Pixel{u, 240})];
    if (u > column(299.5, 0.8) && u < column(399.5, 0.8)) {
      EXPECT_EQ(z, 0.8F) << u;
    } else if (u > column(399.5, 0.8) && u < column(399.5, 2.0)) {
      EXPECT_EQ(z, 0.0F) << u;
    } else {
      EXPECT_EQ(z, 2.0F) << u;
    }
  }
}

TEST(DepthRegistration, OfTheSameCameraChangesNothing) {
  DepthCalibration const same{
      .depth = {500, 510, 31.5, 20.0}, .color = {500, 510, 31.5, 20.0}, .T_color_depth = {}};
  Grid<float> depth_m = cluttered_depth(64, 48, 3);
  Grid<float> const registered_m = register_depth(depth_m, same, 64, 48);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    EXPECT_FLOAT_EQ(registered_m[i], depth_m[i] > 0.0F ? depth_m[i] : 0.0F);
  }
}

TEST(DepthRegistration, OfNothingIsEmpty) {
  EXPECT_EQ(register_depth({}, kinect_calibration(), 3, 2), Grid<float>(3, 2, 0.0F));
  EXPECT_TRUE(register_depth(Grid<float>(3, 2, 1.0F), kinect_calibration(), 0, 0).empty());
  constexpr float kInf = std::numeric_limits<float>::infinity();
  for (float const none : {0.0F, -1.0F, kNaN, kInf, -kInf}) {
    EXPECT_EQ(register_depth(Grid<float>(640, 480, none), kinect_calibration(), 640, 480),
              Grid<float>(640, 480, 0.0F));
  }
}

TEST(DepthRegistration, OfOnePixel) {
  DepthCalibration const same{.depth = {1, 1, 0, 0}, .color = {1, 1, 0, 0}, .T_color_depth = {}};
  EXPECT_EQ(register_depth(Grid<float>(1, 1, 2.0F), same, 1, 1), Grid<float>(1, 1, 2.0F));
}

TEST(DepthRegistration, SeesNothingBehindTheColourCamera) {
  DepthCalibration calibration = small_calibration();
  calibration.T_color_depth = Se3(Eigen::Quaterniond::Identity(), {0.0, 0.0, -1.0});
  EXPECT_EQ(register_depth(Grid<float>(64, 48, 0.9F), calibration, 64, 48),
            Grid<float>(64, 48, 0.0F));
}

// So steep that left and right are swapped between the two cameras.
TEST(DepthRegistration, LeavesOutWhatTheColourCameraSeesFromBehind) {
  DepthCalibration calibration = small_calibration();
  calibration.T_color_depth = Se3(Eigen::Quaterniond::Identity(), {-0.25, 0.0, 0.0});
  calibration.color.cx_px += 45.0;
  Grid<float> depth_m(64, 48);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    depth_m[i] = 0.8F * std::pow(0.975F, static_cast<float>(depth_m.pixel(i).u));
  }
  Grid<float> const registered_m = register_depth(depth_m, calibration, 64, 48);
  expect_same(registered_m, literal_registration(depth_m, calibration, 64, 48));
}

TEST(DepthRegistration, RefusesAFocalLengthOfZero) {
  for (int const which : {0, 1, 2, 3}) {
    DepthCalibration calibration = kinect_calibration();
    CameraIntrinsics& camera = which < 2 ? calibration.depth : calibration.color;
    (which % 2 == 0 ? camera.fx_px : camera.fy_px) = which < 2 ? 0.0 : -525.0;
    EXPECT_THROW((void)register_depth(Grid<float>(2, 2, 1.0F), calibration, 2, 2),
                 std::logic_error);
  }
  EXPECT_THROW((void)register_depth({}, kinect_calibration(), -1, 2), std::logic_error);
}

}  // namespace
}  // namespace credo
