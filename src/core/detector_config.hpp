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
  /// Bingham Procrustean alignment, in this process.
  kBpa,
  /// Another process, asked over DDS.
  kRemote,
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

/// Where known objects are looked for.
enum class ObjectSearch : std::uint8_t {
  /// Around where the belief expects them.
  kTracked,
  /// In the whole frame, each time.
  kGlobal,
  /// Around where the belief expects them; in the whole frame for those not found there.
  kBoth,
};

/// Bingham Procrustean alignment: finds models in depth alone.
struct BpaConfig {
  ObjectSearch search = ObjectSearch::kBoth;
  /// A pose less likely right than this is no detection.
  double min_probability = 0.25;
  /// An object that is not found where it is expected is looked for everywhere once in so many
  /// frames.
  int global_every_frames = 10;
  /// What is found everywhere is told so many frames later: the search runs beside the pipeline
  /// meanwhile. With 0 the frame waits for it; with -1 it is told as soon as it is there, which may
  /// differ from run to run.
  int global_lag_frames = 3;
  int seed = 1;
  /// Where models that were made ready are kept: a folder, `auto` for the user's own cache, empty
  /// for nowhere.
  std::string cache_dir = "auto";
};
FieldList fields(BpaConfig& config);

/// A detector in another process.
struct RemoteDetectorConfig {
  /// A frame that is not answered so long says nothing about known objects.
  double timeout_s = 0.5;
};
FieldList fields(RemoteDetectorConfig& config);

/// The black box behind the interface Detector.
struct DetectorConfig {
  DetectorKind kind = DetectorKind::kNone;
  /// Of recorded detections, JSON lines.
  std::string file;
  SimDetectorConfig sim;
  BpaConfig bpa;
  RemoteDetectorConfig remote;
};
FieldList fields(DetectorConfig& config);

}  // namespace credo
