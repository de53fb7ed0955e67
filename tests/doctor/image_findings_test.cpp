#include <gtest/gtest.h>

#include <cmath>

#include "doctor/finding_matchers.hpp"
#include "doctor/image_times.hpp"
#include "doctor/sensor_findings.hpp"
#include "doctor/usb_bus.hpp"

namespace credo::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

DepthOptics optics(double focal_px) {
  return {640, 480, 2.0 * std::atan(320.0 / focal_px), 2.0 * std::atan(240.0 / focal_px)};
}

/// Of a Kinect that looks at a room.
SensorMeasurement healthy() {
  SensorMeasurement measured;
  measured.usb_vendor = kKinectVendor;
  measured.has_color = true;
  measured.color = image_times(30.0, 3);
  measured.says_registered = true;
  measured.optics = optics(525.0);
  measured.evidence = {.views = 16,
                       .valid_share = 0.8,
                       .median_depth_m = 1.9,
                       .color_brightness = 110.0,
                       .registration = Registration::kRegistered,
                       .floor = std::nullopt};
  return measured;
}

std::vector<Finding> findings_of(SensorMeasurement const& measured,
                                 RegistrationMode mode = RegistrationMode::kAuto) {
  SensorConfig config;
  config.registration = mode;
  return image_findings(measured, {}, config);
}

TEST(ImageFindings, AllIsWell) {
  EXPECT_THAT(
      findings_of(healthy()),
      ElementsAre(ok("depth", "80 % of the pixels have depth, 1.90 m in the middle"),
                  ok("colour image", "110 of 255"), ok("registration", "and its images show it"),
                  ok("focal length", "525.0 px by its field of view")));
}

TEST(ImageFindings, ACoverAWallAndTheSun) {
  SensorMeasurement measured = healthy();
  measured.evidence.valid_share = 0.001;
  EXPECT_THAT(troubles(findings_of(measured)), ElementsAre(error("depth", "0.1 %", "cover")));
  measured.evidence.valid_share = 0.2;
  EXPECT_THAT(troubles(findings_of(measured)), ElementsAre(warning("depth", "20 %", "sunlight")));
  measured.evidence.median_depth_m = 0.55;
  EXPECT_THAT(troubles(findings_of(measured)),
              ElementsAre(warning("depth", "0.55 m", "move back")));
}

TEST(ImageFindings, BlackColour) {
  SensorMeasurement measured = healthy();
  measured.evidence.color_brightness = 2.0;
  EXPECT_THAT(troubles(findings_of(measured)),
              ElementsAre(warning("colour image", "2 of 255: black", "light")));
  measured.evidence.color_brightness.reset();
  EXPECT_THAT(troubles(findings_of(measured)), IsEmpty());
}

TEST(ImageFindings, RegistrationThatIsNotWhatTheSensorSays) {
  SensorMeasurement measured = healthy();
  measured.evidence.registration = Registration::kUnregistered;
  EXPECT_THAT(troubles(findings_of(measured)),
              ElementsAre(warning("registration", "its images show that it is not",
                                  "credo run registers it itself")));
  EXPECT_THAT(troubles(findings_of(measured, RegistrationMode::kSensor)),
              ElementsAre(warning("registration", "its images show that it is not",
                                  "--set sensor.registration=software")));
  measured.says_registered = false;
  measured.optics = optics(575.8);
  measured.evidence.registration = Registration::kRegistered;
  EXPECT_THAT(troubles(findings_of(measured)),
              ElementsAre(warning("registration", "its images show that it is",
                                  "sensor.registration=off")));
}

TEST(ImageFindings, RegistrationThatImagesDoNotTell) {
  SensorMeasurement measured = healthy();
  measured.evidence.registration = Registration::kUndecided;
  EXPECT_THAT(findings_of(measured), Contains(ok("registration", "undecided")));
}

TEST(ImageFindings, RegistrationThatTheSensorCannotDo) {
  SensorMeasurement measured = healthy();
  measured.says_registered = false;
  measured.optics = optics(575.8);
  measured.evidence.registration = Registration::kUnregistered;
  EXPECT_THAT(
      troubles(findings_of(measured)),
      ElementsAre(warning("registration", "cannot register", "credo run registers it itself")));
  EXPECT_THAT(troubles(findings_of(measured, RegistrationMode::kSensor)),
              ElementsAre(warning("registration", "cannot register",
                                  "--set sensor.registration=software")));
  // Asked for.
  EXPECT_THAT(findings_of(measured, RegistrationMode::kOff), Contains(ok("registration", "off")));
  EXPECT_THAT(findings_of(measured, RegistrationMode::kSoftware),
              Contains(ok("registration", "by credo run")));
}

TEST(ImageFindings, WithoutColourRegistrationIsNoMatter) {
  for (bool const has_stream : {false, true}) {
    SensorMeasurement measured = healthy();
    measured.has_color = has_stream;
    measured.color.clear();
    EXPECT_THAT(findings_of(measured), testing::Not(Contains(ok("registration"))));
  }
}

TEST(ImageFindings, FocalLengthAgainstTheConfigs) {
  CaptureConfig capture;
  capture.camera_fx_px = 530.0;
  EXPECT_THAT(image_findings(healthy(), capture, {}),
              Contains(ok("focal length", "530.0 px by capture.camera.fx_px, 525.0 px by its")));
  capture.camera_fx_px = 575.8;
  EXPECT_THAT(image_findings(healthy(), capture, {}),
              Contains(warning("focal length", "575.8 px by capture.camera.fx_px, 525.0 px by")));
}

TEST(ImageFindings, FocalLengthAgainstAKinects) {
  SensorMeasurement measured = healthy();
  measured.optics = optics(575.8);
  EXPECT_THAT(troubles(findings_of(measured)),
              ElementsAre(warning("focal length", "about 525.0 px where depth is registered")));
  measured.usb_vendor = 0;  // of a kind that nothing is known of
  EXPECT_THAT(troubles(findings_of(measured)), IsEmpty());
  // At half the size half the length.
  measured = healthy();
  measured.optics = {320, 240, measured.optics.horizontal_fov_rad,
                     measured.optics.vertical_fov_rad};
  EXPECT_THAT(findings_of(measured), Contains(ok("focal length", "262.5 px")));
}

TEST(ImageFindings, FocalLengthThatNobodyTells) {
  SensorMeasurement measured = healthy();
  measured.optics = {640, 480, std::nullopt, std::nullopt};
  EXPECT_THAT(troubles(findings_of(measured)),
              ElementsAre(warning("focal length", "unknown: taken as 525 px", "fx_px")));
}

/// Of a camera so high, that looks down and is rolled to the right.
Plane floor_below(double height_m, double pitch_rad, double roll_rad) {
  return {{-std::sin(roll_rad) * std::cos(pitch_rad), -std::cos(roll_rad) * std::cos(pitch_rad),
           -std::sin(pitch_rad)},
          -height_m};
}

TEST(FloorFindings, WhereTheFloorIs) {
  ImageEvidence evidence;
  evidence.floor = floor_below(1.2, 0.35, 0.05);
  EXPECT_THAT(floor_findings(evidence, {}),
              ElementsAre(ok("floor",
                             "1.20 m below the sensor, which looks 20.1 degrees down and "
                             "is rolled 2.9 degrees to the right")));
  evidence.floor = floor_below(1.2, -0.1, -0.05);
  EXPECT_THAT(floor_findings(evidence, {}),
              ElementsAre(ok("floor", "5.7 degrees up and is rolled 2.9 degrees to the left")));
}

TEST(FloorFindings, WhatStandsInForIt) {
  PoseConfig pose;
  pose.camera_height_m = 1.4;
  pose.camera_pitch_rad = 0.2;
  EXPECT_THAT(floor_findings({}, pose),
              ElementsAre(warning("floor", "pose.camera_* stands in, 1.40 m up, 11.5 degrees down",
                                  "pose.camera_height_m")));
  pose.level = LevelMode::kOff;
  EXPECT_THAT(floor_findings({}, pose), ElementsAre(ok("floor", "not looked for")));
}

}  // namespace
}  // namespace credo::test
