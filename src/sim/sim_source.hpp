#pragma once

#include <cstddef>

#include "core/capture_config.hpp"
#include "core/frame_source.hpp"
#include "sim/scene.hpp"
#include "sim/scene_caster.hpp"

namespace credo {

/// Plays a scene as an RGB-D camera with the sensor that the scene or the config names: a frame
/// every 1 / frames_per_s from the first waypoint to the last, of the things as they stand then,
/// with the pose that it tells (source frame = the scene's world; true but for the scene's drift
/// and jitter), or none where poses are `fixed`.
class SimSource : public FrameSource {
public:
  /// Throws InputError for a scene that check_scene refuses, or pose.source: file.
  SimSource(Scene const& scene, PoseConfig const& pose, SimConfig const& sim = {});

  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }
  SourceResult next() override;

private:
  SceneCaster world_;
  bool has_poses_;
  int seed_;
  std::size_t frame_count_;
  std::size_t position_ = 0;
};

}  // namespace credo
