#include "doctor/image_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/sensor_views.hpp"
#include "tools/scene_file.hpp"

namespace credo::test {
namespace {

/// As small as can be looked at.
DepthOptics small() {
  return {64, 48, 2.0 * std::atan(32.0 / 60.0), 2.0 * std::atan(24.0 / 60.0)};
}

TEST(ImageEvidence, OfNoViews) {
  ImageEvidence const evidence = evidence_of({}, small(), {});
  EXPECT_EQ(evidence.views, 0);
  EXPECT_EQ(evidence.valid_share, 0.0);
  EXPECT_EQ(evidence.color_brightness, std::nullopt);
  EXPECT_EQ(evidence.registration, Registration::kUndecided);
  EXPECT_EQ(evidence.floor, std::nullopt);
}

TEST(ImageEvidence, SharesAndMeansOverAllViews) {
  SensorView near{Grid<float>(64, 48, 1.0F), Grid<Rgb>(64, 48, Rgb{30, 60, 90})};
  SensorView far{Grid<float>(64, 48, 3.0F), {}};
  SensorView none{Grid<float>(64, 48, 0.0F), Grid<Rgb>(64, 48, Rgb{0, 0, 0})};
  far.depth_m[0] = 0.0F;
  ImageEvidence const evidence = evidence_of({near, far, none}, small(), {});
  EXPECT_EQ(evidence.views, 3);
  EXPECT_NEAR(evidence.valid_share, (2.0 - 1.0 / (64 * 48)) / 3.0, 1e-9);
  EXPECT_EQ(evidence.median_depth_m, 1.0);
  EXPECT_DOUBLE_EQ(evidence.color_brightness.value_or(0.0), 30.0);
}

TEST(ImageEvidence, OfARoomAsAKinectSeesIt) {
  Scene const scene = load_scene("cluttered-table");
  std::vector<SensorView> registered;
  std::vector<SensorView> raw;
  for (int i = 0; i < 6; ++i) {
    auto views = sensor_views(scene, SensorModel::kGaussian, i / 6.0);
    registered.push_back({views.registered_m, views.color});
    raw.push_back({views.depth_m, views.color});
  }
  DepthOptics const optics{640, 480, 2.0 * std::atan(320.0 / 525.0),
                           2.0 * std::atan(240.0 / 525.0)};
  ImageEvidence const evidence = evidence_of(registered, optics, {});
  EXPECT_EQ(evidence.registration, Registration::kRegistered);
  EXPECT_EQ(evidence_of(raw, optics, {}).registration, Registration::kUnregistered);
  ASSERT_TRUE(evidence.floor);
  EXPECT_NEAR(evidence.floor->signed_distance_m({0, 0, 0}), 1.5, 0.03);
  // The config's focal length goes before.
  CaptureConfig capture;
  capture.camera_fx_px = capture.camera_fy_px = 2000.0;
  capture.camera_cx_px = 319.5;
  capture.camera_cy_px = 239.5;
  auto const narrow = evidence_of(registered, optics, capture).floor;
  EXPECT_TRUE(!narrow || std::abs(narrow->signed_distance_m({0, 0, 0}) - 1.5) > 0.1);
}

}  // namespace
}  // namespace credo::test
