// A sensor that does not do what it is told: registers no depth, forgets its settings.
#include <OpenNI.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/cloud.hpp"
#include "drivers/virtual/virtual_source.hpp"
#include "io/dataset_writer.hpp"
#include "support/sensor_views.hpp"
#include "tools/scene_file.hpp"

namespace credo::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// The share of pixels whose depth is the registered image's, to the mm.
double share_registered(Frame const& frame, std::size_t images) {
  std::size_t most = 0;
  for (std::size_t image = 0; image < images; ++image) {
    Grid<std::uint16_t> const expected = depth_of(image);
    std::size_t same = 0;
    for (std::size_t p = 0; p < expected.size(); ++p) {
      same += std::abs(1000 * frame.cloud_camera.z[p] - expected[p]) <= 0.5 ? 1U : 0U;
    }
    most = std::max(most, same);
  }
  return static_cast<double>(most) / static_cast<double>(frame.cloud_camera.size());
}

TEST_F(VirtualSource, WhatTheSensorCannotRegisterIsRegisteredHere) {
  std::map<RegistrationMode, double> share;
  for (RegistrationMode const mode : {RegistrationMode::kAuto, RegistrationMode::kOff}) {
    opened_ = {};
    next_index_ = 0;
    SensorConfig config;
    config.registration = mode;
    open(R"({"fault": "registration_missing"})", config);
    Seen const seen = read_until(0.3);
    EXPECT_EQ(seen.frames.back()->color_registered, mode == RegistrationMode::kAuto);
    share[mode] = share_registered(*seen.frames.back(), 12);
  }
  EXPECT_GT(share[RegistrationMode::kAuto], 0.6);
  EXPECT_LT(share[RegistrationMode::kOff], 0.4);
}

constexpr int kViews = 3;

/// A table with things on it as a Kinect sees it, depth registered; the camera moves a little.
std::vector<Grid<float>> write_table(std::filesystem::path const& folder) {
  Scene const scene = load_scene("cluttered-table");
  DatasetWriter writer(folder);
  std::vector<Grid<float>> depths_m;
  for (int i = 0; i < kViews; ++i) {
    SensorViews const views = sensor_views(scene, SensorModel::kDisparity, i / 6.0);
    Frame frame;
    frame.index = FrameIndex{i};
    frame.stamp_ns = i * 33'333'333LL;
    frame.intrinsics = kinect_calibration().color;
    frame.cloud_camera = cloud_from_depth(views.registered_m, frame.intrinsics);
    frame.color = views.color;
    writer.write(frame);
    depths_m.push_back(views.registered_m);
  }
  return depths_m;
}

/// The share of a frame's depth that is, within 2 cm, one of those images'.
double share_like(Frame const& frame, std::vector<Grid<float>> const& depths_m) {
  double most = 0.0;
  for (Grid<float> const& depth_m : depths_m) {
    int valid = 0;
    int same = 0;
    for (std::size_t p = 0; p < depth_m.size(); ++p) {
      float const z_m = frame.cloud_camera.z[p];
      valid += z_m > 0.0F ? 1 : 0;
      same += std::abs(z_m - depth_m[p]) < 0.02F ? 1 : 0;
    }
    most = std::max(most, static_cast<double>(same) / valid);
  }
  return most;
}

TEST_F(VirtualSource, WhatTheSensorDoesNotRegisterThoughItSaysSoIsRegisteredHere) {
  auto const depths_m = write_table(folder_ / "a");
  SensorConfig believing;
  believing.registration = RegistrationMode::kSensor;
  open_sensor(R"({"fault": "registration_ignored"})", believing);
  EXPECT_LT(share_like(*read_until(1.0).frames.back(), depths_m), 0.8);
  opened_ = {};
  next_index_ = 0;

  open_sensor(R"({"fault": "registration_ignored"})", {});
  double time_s = 0.0;
  while (notes_.empty() && time_s < 30.0) {
    time_s += 0.5;
    read_until(time_s);
  }
  EXPECT_THAT(notes_, Contains(HasSubstr("its images show that its depth is not registered")));
  Seen const after = read_until(time_s + 0.5);
  EXPECT_GT(share_like(*after.frames.back(), depths_m), 0.95);
  EXPECT_TRUE(after.frames.back()->color_registered);
  EXPECT_NEAR(after.frames.back()->intrinsics.fx_px, 525.0, 0.1);
}

TEST_F(VirtualSource, WhatTheSensorRegistersStaysAsItIs) {
  auto const depths_m = write_table(folder_ / "a");
  open_sensor("", {});
  Seen const seen = read_until(3.0);
  EXPECT_THAT(notes_, Not(Contains(HasSubstr("not registered"))));
  EXPECT_GT(share_like(*seen.frames.back(), depths_m), 0.999);
}

/// What the sensor's colour camera is set to.
openni::CameraSettings& settings_of(openni::Device& device, openni::VideoStream& color) {
  EXPECT_EQ(device.open("virtual://a"), openni::STATUS_OK);
  EXPECT_EQ(color.create(device, openni::SENSOR_COLOR), openni::STATUS_OK);
  return *color.getCameraSettings();
}

// Each start of its colour sets the sensor back to what it came with.
TEST_F(VirtualSource, SettingsThatAStartForgetsAreAppliedAfterIt) {
  SensorConfig config;
  config.auto_exposure = SensorSwitch::kOff;
  config.auto_white_balance = SensorSwitch::kOff;
  config.exposure = 7;
  config.gain = 9;
  config.stall_s = 0.3;
  open(
      R"({"fault": "forget_settings"}, {"fault": "stall", "stream": "color", "at_s": 0.5, "for_s": 1})",
      config);
  openni::Device device;
  openni::VideoStream color;
  openni::CameraSettings& settings = settings_of(device, color);
  auto const expect_ours = [&] {
    EXPECT_FALSE(settings.getAutoExposureEnabled());
    EXPECT_FALSE(settings.getAutoWhiteBalanceEnabled());
    EXPECT_EQ(settings.getExposure(), 7);
    EXPECT_EQ(settings.getGain(), 9);
  };
  read_until(0.3);
  expect_ours();
  read_until(2.5);
  EXPECT_THAT(notes_, Contains(HasSubstr("sends no colour; starting it anew")));
  expect_ours();
  color.destroy();
  device.close();
}

}  // namespace
}  // namespace credo::test
