#pragma once

#include "core/frame.hpp"
#include "sim/scene.hpp"

namespace credo {

/// The pose that a camera tells in a frame where `T_world_camera` is true: with the scene's drift
/// and jitter. The same for the same seed and frame; the true one where the scene has neither.
Se3 told_pose(SceneCamera const& camera, Se3 const& T_world_camera, double since_start_s, int seed,
              FrameIndex index);

}  // namespace credo
