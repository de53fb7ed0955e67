#pragma once

#include <memory>

#include "sim/ray_caster.hpp"
#include "sim/scene.hpp"

namespace credo {

/// The ray caster of a scene as time goes by: built anew only where the world has changed since
/// (world_changes).
class SceneCaster {
public:
  /// Throws InputError for a scene that check_scene refuses.
  explicit SceneCaster(Scene scene);

  [[nodiscard]] Scene const& scene() const { return scene_; }
  /// Of the things as they stand at a time. Good until the next call.
  RayCaster const& at(double time_s);

private:
  Scene scene_;
  std::unique_ptr<RayCaster const> caster_;
  double time_s_ = 0.0;
};

}  // namespace credo
