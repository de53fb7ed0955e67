#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/fields.hpp"

namespace credo {

/// Who looks for known objects.
enum class DetectorKind : std::uint8_t {
  /// Nobody: that an object is not found then says nothing about it.
  kNone,
  /// A file of recorded detections.
  kRecorded,
  /// The truth of a simulated scene, spoilt as told.
  kSim,
};

/// A detector that knows the truth of a simulated scene, and how far it strays from it.
struct SimDetectorConfig {
  /// Standard deviations of a pose's errors along and about each axis of the camera.
  double sigma_position_m = 0.005;
  double sigma_rotation_rad = 0.02;
  /// Added to every position, along the world's axes: a model or a calibration that is off.
  std::vector<double> bias_position_m = {0, 0, 0};
  double miss_probability = 0.0;
  /// Mean number of detections of things that are not there.
  double false_alarms_per_frame = 0.0;
  /// What shows a smaller part of itself is not found.
  double min_visible_fraction = 0.2;
  /// Each call takes at least so long, as a slow detector would; it changes no result.
  double latency_s = 0.0;
  int seed = 1;
};
FieldList fields(SimDetectorConfig& config);

/// The black box behind the interface Detector.
struct DetectorConfig {
  DetectorKind kind = DetectorKind::kNone;
  /// Of recorded detections, JSON lines.
  std::string file;
  SimDetectorConfig sim;
};
FieldList fields(DetectorConfig& config);

}  // namespace credo
