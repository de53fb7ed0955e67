#include "sim/scene_time.hpp"

#include <algorithm>

namespace credo {
namespace {

/// A frame's time is a sum, 0.1 + 0.7 < 0.8: an event at that time must not come a frame late.
constexpr double kRounding_s = 1e-9;

bool starts_present(Scene const& scene, SceneThing const& thing) {
  auto const first =
      std::find_if(scene.events.begin(), scene.events.end(),
                   [&](SceneEvent const& event) { return event.thing == thing.name; });
  return first == scene.events.end() || first->what != SceneChange::kAppeared;
}

/// What an event leaves of a thing: `own` as Scene::things has it, `before` as it stood.
std::optional<SceneThing> after(SceneEvent const& event, SceneThing const& own,
                                std::optional<SceneThing> const& before) {
  if (event.what == SceneChange::kRemoved) {
    return std::nullopt;
  }
  SceneThing thing = before.value_or(own);
  if (!event.position_m.empty()) {
    thing.position_m = event.position_m;
  }
  if (!event.rpy_deg.empty()) {
    thing.rpy_deg = event.rpy_deg;
  }
  return thing;
}

}  // namespace

double scene_time_s(Scene const& scene, FrameIndex index) {
  return scene.camera.path.front().time_s +
         static_cast<double>(number(index)) / scene.camera.frames_per_s;
}

std::size_t event_count_at(Scene const& scene, double time_s) {
  auto const next =
      std::find_if(scene.events.begin(), scene.events.end(),
                   [&](SceneEvent const& event) { return event.time_s > time_s + kRounding_s; });
  return static_cast<std::size_t>(next - scene.events.begin());
}

PresentThings things_at(Scene const& scene, double time_s) {
  std::size_t const event_count = event_count_at(scene, time_s);
  PresentThings present;
  for (SceneThing const& thing : scene.things) {
    std::optional<SceneThing>& now = present.emplace_back();
    if (starts_present(scene, thing)) {
      now = thing;
    }
    for (std::size_t i = 0; i < event_count; ++i) {
      if (scene.events[i].thing == thing.name) {
        now = after(scene.events[i], thing, now);
      }
    }
  }
  return present;
}

}  // namespace credo
