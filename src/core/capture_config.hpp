#pragma once

#include <cstdint>
#include <string>

#include "core/fields.hpp"
#include "core/frame.hpp"

namespace credo {

/// How a source's clouds are oriented.
enum class CloudAxes : std::uint8_t {
  /// y_up_z_back where most points of a cloud lie behind the camera (z < 0), else optical.
  kAuto,
  /// The camera's optical frame: x right, y down, z forward.
  kOptical,
  /// x right, y up, z backward (OpenGL), as some PCD files come.
  kYUpZBack,
};

/// Whether colour is registered to depth.
enum class ColorRegistered : std::uint8_t {
  /// As far as the source knows; what does not know is not.
  kAuto,
  kYes,
  kNo,
};

/// What every source must be told, because recordings do not carry it.
struct CaptureConfig {
  /// Used where the recording has no camera-intrinsics.txt; 0 = not given.
  double camera_fx_px = 0.0;
  double camera_fy_px = 0.0;
  double camera_cx_px = 0.0;
  double camera_cy_px = 0.0;
  CloudAxes axes = CloudAxes::kAuto;
  /// Metres per count of a 16-bit depth image; 0 = the layout's own (0.001, TUM 0.0002).
  double depth_unit_m = 0.0;
  /// Colour helps to tell things apart where it is registered to depth.
  ColorRegistered color_registered = ColorRegistered::kAuto;
  /// Depth beyond this is taken as invalid.
  double max_depth_m = 10.0;
  /// Each frame is a scene of its own: fresh belief, fresh level.
  bool independent_frames = false;
};
FieldList fields(CaptureConfig& config);

/// For a source that knows by itself whether its colour is registered.
[[nodiscard]] bool is_color_registered(CaptureConfig const& config, bool as_known);

/// Where camera poses come from.
enum class PoseSource : std::uint8_t {
  /// The recording's own; a recording without any stands still.
  kRecorded,
  /// A trajectory file: lines `stamp_s tx ty tz qx qy qz qw`, or 16 numbers a frame.
  kFile,
  /// The sensor stands still, whatever the recording says.
  kFixed,
};

enum class LevelMode : std::uint8_t {
  /// The source is level.
  kOff,
  /// By the floor in the first frames, where the source is not level already.
  kAuto,
  /// The first camera stands as PoseConfig says, on a floor at z = 0: a calibration.
  kGiven,
  /// By the floor in the first frames, however little it leans (T).
  kByFloor,
};

/// Poses, and how the world is found from them (world = source turned level, floor at z = 0).
struct PoseConfig {
  PoseSource source = PoseSource::kRecorded;
  std::string file;
  LevelMode level = LevelMode::kAuto;
  /// The camera where no floor is in view, or of LevelMode::kGiven: downward pitch, roll to the
  /// right, height above the floor.
  double camera_pitch_rad = 0.0;
  double camera_roll_rad = 0.0;
  double camera_height_m = 1.0;
  /// Of LevelMode::kGiven: turned so far about the world's z, counterclockwise from above, beyond
  /// what LevelMode::kAuto would make of it (where the view goes along +y), and where it stands.
  double camera_yaw_rad = 0.0;
  double camera_x_m = 0.0;
  double camera_y_m = 0.0;
  /// Frames to read ahead, at most, in search of the floor.
  int level_frames = 30;
};
FieldList fields(PoseConfig& config);

}  // namespace credo
