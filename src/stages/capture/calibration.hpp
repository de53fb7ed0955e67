#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/capture_config.hpp"
#include "core/cloud.hpp"
#include "core/label.hpp"
#include "core/plane.hpp"
#include "geometry/plane_search.hpp"
#include "stages/capture/still_surface.hpp"

namespace credo {

/// What one frame of a camera that stands still says.
struct CalibrationLook {
  PlaneSearchPoints points_camera;
  /// As find_floor sees it; none where no floor is in view.
  std::optional<Plane> floor_camera;
};
CalibrationLook look_for_floor(OrganizedCloud const& cloud_camera);

/// Where a camera stands: the values of PoseConfig's camera_*, or how far they spread over frames.
/// Without a wall yaw, x and y are 0. With one the wall is the plane x = 0, x points from it into
/// the room, and the camera stands at y = 0.
struct CameraStand {
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
  double height_m = 0.0;
  double yaw_rad = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
};
/// Camera frame, the floor's normal up and the wall's towards the camera.
CameraStand stand_of(Plane const& floor, std::optional<Plane> const& wall);

/// The config of a camera that stands so: LevelMode::kGiven and the camera_*.
PoseConfig given_pose(CameraStand const& camera);

struct Calibration {
  CameraStand camera;
  /// Standard deviations of what each frame by itself would have said; none from fewer than two
  /// frames that show all of it.
  std::optional<CameraStand> spread;
  StillSurface floor;
  std::optional<StillSurface> wall;
  /// Of the wall fitted freely, against the floor: 0 where the depth image is true.
  double wall_lean_rad = 0.0;
};

/// Why there is no calibration.
enum class CalibrationFault : std::uint8_t {
  /// Less than half of the frames show a floor.
  kNoFloor,
  /// They do, but less than half in one place: the camera moved, or takes other things for it.
  kFloorMoves,
  /// No wall in view that find_wall takes for one.
  kNoWall,
};

struct CalibrationResult {
  /// None: see `fault`.
  std::optional<Calibration> calibration;
  CalibrationFault fault = CalibrationFault::kNoFloor;
  /// Frames that show a floor at all, and those of them that agree about it.
  int frames_with_floor = 0;
  int frames_agreeing = 0;
};

/// The floor of all frames: the median of what the frames say is a first guess; those that see it
/// elsewhere (by 2 degrees or 4 cm) are left out, and the points of the others are fitted together
/// (fit_still_surface). With `with_wall` the most prominent wall (find_wall) likewise, upright on
/// that floor. The looks are used up.
CalibrationResult calibrate(std::vector<CalibrationLook> looks, bool with_wall);

/// Which pixels of a frame lie on the floor (kFloor) or the wall (kFirstWall), within the gates of
/// the fits; the others are kUnassigned or kNoDepth.
LabelMap surfaces_in(OrganizedCloud const& cloud_camera, Calibration const& calibration);

}  // namespace credo
