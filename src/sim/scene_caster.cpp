#include "sim/scene_caster.hpp"

#include <utility>

#include "sim/scene_time.hpp"

namespace credo {

SceneCaster::SceneCaster(Scene scene) : scene_(std::move(scene)) {
  check_scene(scene_);
}

RayCaster const& SceneCaster::at(double time_s) {
  if (caster_ == nullptr || world_changes(scene_, time_s_, time_s)) {
    caster_ = std::make_unique<RayCaster const>(scene_, time_s);
  }
  time_s_ = time_s;
  return *caster_;
}

}  // namespace credo
