#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "doctor/sensor_findings.hpp"
#include "doctor/text.hpp"
#include "doctor/usb_bus.hpp"

namespace credo {
namespace {

/// Even a room with windows and black things gives more.
constexpr double kHardlyValid = 0.02;
constexpr double kFewValid = 0.3;
/// A Kinect sees nothing nearer than 0.5 m; where half of the image is about there, more of it is
/// not seen.
constexpr double kNear_m = 0.6;
/// Of 255.
constexpr double kBlack = 5.0;
constexpr double kFocalDiffers = 0.03;
/// At a width of 640 pixels: of depth in the colour camera's image, and in its own.
constexpr double kRegisteredFocal_px = 525.0;
constexpr double kDepthFocal_px = 575.8;
constexpr double kKinectWidth_px = 640.0;

void judge_depth(ImageEvidence const& evidence, Section& section) {
  std::string const found = percent_text(evidence.valid_share) + " of the pixels have depth, " +
                            fixed_text(evidence.median_depth_m, 2) + " m in the middle";
  if (evidence.valid_share < kHardlyValid) {
    section.error("depth", percent_text(evidence.valid_share) + " of the pixels have depth",
                  "take off the cover; sensors see from 0.5 to 5 m, nothing in sunlight, and each "
                  "other's dots: turn it to a room");
  } else if (evidence.median_depth_m < kNear_m) {
    section.warning("depth", found, "move back: a Kinect sees nothing nearer than 0.5 m");
  } else if (evidence.valid_share < kFewValid) {
    section.warning("depth", found,
                    "is all too near or too far, in sunlight, of glass or black? Sensors see from "
                    "0.5 to 5 m");
  } else {
    section.ok("depth", found);
  }
}

void judge_brightness(ImageEvidence const& evidence, Section& section) {
  if (!evidence.color_brightness) {
    return;
  }
  std::string const found =
      "mean brightness " + fixed_text(*evidence.color_brightness, 0) + " of 255";
  if (*evidence.color_brightness < kBlack) {
    section.warning("colour image", found + ": black", "take off the cover, put on the light");
  } else {
    section.ok("colour image", found);
  }
}

void judge_sensors_registration(Registration shown, bool credo_would, Section& section) {
  switch (shown) {
    case Registration::kRegistered:
      section.ok("registration",
                 "the sensor says that its depth is registered to its colour, and "
                 "its images show it");
      return;
    case Registration::kUndecided:
      section.ok("registration",
                 "the sensor says that its depth is registered to its colour; its "
                 "images do not tell (undecided): they take things before others, "
                 "in colours that differ");
      return;
    case Registration::kUnregistered:
      section.warning("registration",
                      "the sensor says that its depth is registered to its colour, and its images "
                      "show that it is not",
                      credo_would ? "nothing: credo run registers it itself, once its images show "
                                    "that, by what is known of a Kinect; to have it from the first "
                                    "frame on: --set sensor.registration=software"
                                  : "--set sensor.registration=software");
      return;
  }
}

void judge_registration(SensorMeasurement const& measured, SensorConfig const& config,
                        Section& section) {
  Registration const shown = measured.evidence.registration;
  if (measured.is_recording || !measured.has_color || measured.color.empty()) {
    return;
  }
  if (measured.says_registered) {
    judge_sensors_registration(shown, config.registration == RegistrationMode::kAuto, section);
  } else if (config.registration == RegistrationMode::kOff ||
             config.registration == RegistrationMode::kSoftware) {
    section.ok("registration", config.registration == RegistrationMode::kOff
                                   ? "off, as sensor.registration says"
                                   : "by credo run, as sensor.registration says");
  } else if (shown == Registration::kRegistered) {
    section.warning("registration",
                    "the sensor says that its depth is not registered to its colour, and its "
                    "images show that it is",
                    "--set sensor.registration=off --set capture.color_registered=yes");
  } else {
    section.warning("registration", "the sensor cannot register its depth to its colour",
                    config.registration == RegistrationMode::kAuto
                        ? "nothing: credo run registers it itself, by what is known of a Kinect"
                        : "--set sensor.registration=software");
  }
}

bool differs(double a, double b) {
  return std::abs(a - b) > kFocalDiffers * b;
}

/// What is known of a Kinect's focal length where its depth is in that camera's image.
double known_focal_px(SensorMeasurement const& measured) {
  double const scale = measured.optics.width_px / kKinectWidth_px;
  return scale * (measured.says_registered ? kRegisteredFocal_px : kDepthFocal_px);
}

void judge_focal_length(SensorMeasurement const& measured, CaptureConfig const& capture,
                        Section& section) {
  CameraIntrinsics const own = intrinsics_of(measured.optics, {});
  bool const tells = measured.optics.horizontal_fov_rad.value_or(0.0) > 0.0;
  bool const is_known_kind =
      measured.usb_vendor == kKinectVendor || measured.usb_vendor == kPrimeSenseVendor;
  std::string const of_view = tells ? fixed_text(own.fx_px, 1) + " px by its field of view"
                                    : "its field of view is unknown";
  if (capture.camera_fx_px > 0.0) {
    std::string const found =
        fixed_text(capture.camera_fx_px, 1) + " px by capture.camera.fx_px, " + of_view;
    if (tells && differs(capture.camera_fx_px, own.fx_px)) {
      section.warning("focal length", found,
                      "sizes scale with it: was capture.camera measured with this sensor, in this "
                      "mode and registration? Else take it out of the config");
    } else {
      section.ok("focal length", found);
    }
  } else if (!tells) {
    section.warning("focal length", of_view + ": taken as 525 px at a width of 640",
                    "measure it, and set capture.camera.fx_px, fy_px, cx_px and cy_px");
  } else if (is_known_kind && differs(own.fx_px, known_focal_px(measured))) {
    section.warning("focal length",
                    of_view + ", and a Kinect's or Xtion's is about " +
                        fixed_text(known_focal_px(measured), 1) + " px where depth is " +
                        (measured.says_registered ? "registered to colour" : "not registered"),
                    "measure a box of known size; if credo sees it wrong by as much, set "
                    "capture.camera.fx_px, fy_px, cx_px and cy_px");
  } else {
    section.ok("focal length", of_view);
  }
}

std::string degrees_text(double rad) {
  return fixed_text(std::abs(rad) * 180.0 / std::numbers::pi, 1) + " degrees";
}

}  // namespace

std::vector<Finding> image_findings(SensorMeasurement const& measured, CaptureConfig const& capture,
                                    SensorConfig const& config) {
  Section section("images");
  judge_depth(measured.evidence, section);
  judge_brightness(measured.evidence, section);
  judge_registration(measured, config, section);
  judge_focal_length(measured, capture, section);
  return section.take();
}

std::vector<Finding> floor_findings(ImageEvidence const& evidence, PoseConfig const& pose) {
  Section section("floor");
  if (pose.level == LevelMode::kOff) {
    section.ok("floor", "not looked for, as pose.level says: the sensor is taken as level");
  } else if (evidence.floor) {
    // The floor's normal is up in the camera's frame, whose y points down and z ahead.
    Eigen::Vector3d const up = evidence.floor->normal;
    double const pitch_rad = std::asin(std::clamp(-up.z(), -1.0, 1.0));
    double const roll_rad = std::atan2(-up.x(), -up.y());
    section.ok("floor", fixed_text(evidence.floor->signed_distance_m(Eigen::Vector3d::Zero()), 2) +
                            " m below the sensor, which looks " + degrees_text(pitch_rad) +
                            (pitch_rad < 0.0 ? " up" : " down") + " and is rolled " +
                            degrees_text(roll_rad) +
                            (roll_rad < 0.0 ? " to the left" : " to the right"));
  } else {
    section.warning("floor",
                    "none in view: pose.camera_* stands in, " +
                        fixed_text(pose.camera_height_m, 2) + " m up, " +
                        degrees_text(pose.camera_pitch_rad) +
                        (pose.camera_pitch_rad < 0.0 ? " up" : " down"),
                    "turn it until a good part of the floor is in view; or measure how it stands, "
                    "and set pose.camera_height_m, camera_pitch_rad and camera_roll_rad");
  }
  return section.take();
}

}  // namespace credo
