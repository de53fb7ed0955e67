#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "core/capture_config.hpp"
#include "core/frame.hpp"

namespace credo {

/// The level world: z up, the floor at z = 0; x, y and yaw are the source's.
struct WorldLevel {
  Se3 T_world_source;
  /// False where no floor was in view and the config's camera pose stood in: z = 0 is then no
  /// floor.
  bool floor_found = false;
  /// One line for the log: what the level rests on.
  std::string note;
  /// Told by the config (LevelMode::kGiven), not found in this run.
  bool given = false;
};

/// Which way is up for a camera pitched down and then rolled to the right; unit, camera frame.
Eigen::Vector3d up_of_camera(double pitch_rad, double roll_rad);

/// The camera that a level camera_* of the config tell: the least rotation that takes its up to +z,
/// as where the floor is found, then camera_yaw_rad about z.
Se3 given_camera(PoseConfig const& config);

/// Finds the level from the first frames of a run (method: the large near-horizontal plane with
/// nothing beneath it). A source in which that floor leans no more than one frame's floor may be
/// wrong by (floor_lean.hpp) is level as it is and is not turned; nor shifted, if its z = 0 may be
/// the floor, unless LevelMode::kByFloor says so. LevelMode::kOff gives the identity with
/// floor_found = true; LevelMode::kGiven puts the first of them where the config says, also with
/// floor_found = true.
WorldLevel find_level(std::span<FramePtr const> frames, PoseConfig const& config);

}  // namespace credo
