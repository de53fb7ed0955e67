#pragma once

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
};

/// Finds the level from the first frames of a run (method: the large near-horizontal plane with
/// nothing beneath it). LevelMode::kOff gives the identity with floor_found = true.
WorldLevel find_level(std::span<FramePtr const> frames, PoseConfig const& config);

}  // namespace credo
