#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/capture_config.hpp"
#include "core/sensor_config.hpp"
#include "doctor/image_evidence.hpp"
#include "doctor/stream_timing.hpp"
#include "openni/sensor_image.hpp"

namespace credo {

/// What a sensor did over some seconds.
struct SensorMeasurement {
  std::string uri;
  std::uint16_t usb_vendor = 0;
  /// What it said when it was opened, one line each.
  std::vector<std::string> warnings;
  /// A recording that OpenNI2 plays.
  bool is_recording = false;
  bool has_color = false;
  /// Of the modes in which the streams run.
  int depth_rate_hz = 0;
  int color_rate_hz = 0;
  DepthOptics optics;
  bool says_registered = false;

  /// How long was waited for the first depth image, in vain or not.
  double waited_s = 0.0;
  /// From the first depth image on.
  double measured_s = 0.0;
  std::vector<ImageTime> depth;
  std::vector<ImageTime> color;
  /// Depth images that were not whole, and what was wrong with the last.
  int broken = 0;
  std::string broken_why;
  /// It went while it was measured.
  bool unplugged = false;
  std::uint64_t clock_jumps = 0;
  ImageEvidence evidence;
};

/// Takes what is being done, and for how long: "measuring", 1.2, 3.
using MeasureProgress = std::function<void(std::string const& what, double s, double of_s)>;

/// Opens a sensor (`uri` empty: the first one found), waits for its first depth image for
/// sensor.first_frame_s at most, and takes what comes for `seconds`. Wants an OpenniLibrary. Throws
/// InputError where it does not open.
SensorMeasurement measure_sensor(std::string const& uri, double seconds,
                                 CaptureConfig const& capture, SensorConfig const& sensor,
                                 MeasureProgress const& progress);

}  // namespace credo
