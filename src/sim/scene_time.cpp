#include "sim/scene_time.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace credo {
namespace {

/// A frame's time is a sum, 0.1 + 0.7 < 0.8: an event or a rest from then on must not come a frame
/// late.
constexpr double kRounding_s = 1e-9;

bool starts_present(Scene const& scene, SceneThing const& thing) {
  auto const first =
      std::find_if(scene.events.begin(), scene.events.end(),
                   [&](SceneEvent const& event) { return event.thing == thing.name; });
  return first == scene.events.end() || first->what != SceneChange::kAppeared;
}

std::size_t position_of(Scene const& scene, std::string const& name) {
  auto const found = std::find_if(scene.things.begin(), scene.things.end(),
                                  [&](SceneThing const& thing) { return thing.name == name; });
  return static_cast<std::size_t>(found - scene.things.begin());
}

/// What an event makes of the things.
void apply(Scene const& scene, SceneEvent const& event, PresentThings& things) {
  std::size_t const index = position_of(scene, event.thing);
  std::optional<SceneThing>& thing = things[index];
  if (event.what == SceneChange::kRemoved) {
    thing.reset();
  } else if (event.what == SceneChange::kSwapped) {
    std::swap(thing.value().position_m, things[position_of(scene, event.with)].value().position_m);
  } else {
    if (!thing.has_value()) {
      thing = scene.things[index];
    }
    if (!event.position_m.empty()) {
      thing->position_m = event.position_m;
    }
    if (!event.rpy_deg.empty()) {
      thing->rpy_deg = event.rpy_deg;
    }
  }
}

/// The things after so many events; what has a path is where Scene::things has it.
PresentThings after_events(Scene const& scene, std::size_t event_count) {
  PresentThings things;
  for (SceneThing const& thing : scene.things) {
    things.push_back(starts_present(scene, thing) ? std::optional(thing) : std::nullopt);
  }
  for (std::size_t i = 0; i < event_count; ++i) {
    apply(scene, scene.events[i], things);
  }
  return things;
}

/// Position on a path that is not empty. Resting gives the same numbers at all times.
ThingWaypoint on_path(std::vector<ThingWaypoint> const& path, double time_s) {
  auto const next = std::find_if(path.begin(), path.end(), [&](ThingWaypoint const& waypoint) {
    return waypoint.time_s > time_s + kRounding_s;
  });
  if (next == path.begin()) {
    return path.front();
  }
  ThingWaypoint now = *std::prev(next);
  if (next != path.end()) {
    double const share = std::max(0.0, time_s - now.time_s) / (next->time_s - now.time_s);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      now.position_m[axis] += share * (next->position_m[axis] - now.position_m[axis]);
    }
    now.yaw_deg += share * (next->yaw_deg - now.yaw_deg);
  }
  return now;
}

/// The thing where its path has it at a time, if it has one.
SceneThing placed(SceneThing thing, double time_s) {
  if (!thing.path.empty()) {
    ThingWaypoint const now = on_path(thing.path, time_s);
    thing.position_m = now.position_m;
    thing.rpy_deg[2] += now.yaw_deg;
    thing.path.clear();
  }
  return thing;
}

bool moves(SceneThing const& thing, double from_s, double to_s) {
  if (thing.path.empty()) {
    return false;
  }
  ThingWaypoint const from = on_path(thing.path, from_s);
  ThingWaypoint const to = on_path(thing.path, to_s);
  return from.position_m != to.position_m || from.yaw_deg != to.yaw_deg;
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

bool world_changes(Scene const& scene, double from_s, double to_s) {
  return event_count_at(scene, from_s) != event_count_at(scene, to_s) ||
         std::any_of(scene.things.begin(), scene.things.end(),
                     [&](SceneThing const& thing) { return moves(thing, from_s, to_s); });
}

PresentThings things_at(Scene const& scene, double time_s) {
  PresentThings things = after_events(scene, event_count_at(scene, time_s));
  for (std::optional<SceneThing>& thing : things) {
    if (thing.has_value()) {
      thing = placed(*std::move(thing), time_s);
    }
  }
  return things;
}

SceneThing last_known(Scene const& scene, std::size_t thing, double time_s) {
  std::size_t const count = event_count_at(scene, time_s);
  if (auto now = after_events(scene, count)[thing]; now.has_value()) {
    return placed(*std::move(now), time_s);
  }
  auto const is_about = [&](SceneEvent const& event) {
    return event.thing == scene.things[thing].name;
  };
  auto const now = scene.events.begin() + static_cast<std::ptrdiff_t>(count);
  // What is absent was removed last, or appears next.
  auto const removal = std::find_if(std::make_reverse_iterator(now), scene.events.rend(), is_about);
  bool const was_there = removal != scene.events.rend();
  auto const event =
      was_there ? std::prev(removal.base()) : std::find_if(now, scene.events.end(), is_about);
  auto const before = static_cast<std::size_t>(event - scene.events.begin());
  return placed(after_events(scene, was_there ? before : before + 1)[thing].value(), event->time_s);
}

std::vector<std::size_t> motions_at(Scene const& scene, FrameIndex index) {
  std::vector<std::size_t> moved;
  if (number(index) == 0) {
    return moved;
  }
  auto const time_s = [&](int later) {
    return scene_time_s(scene, FrameIndex{number(index) + later});
  };
  PresentThings const before = after_events(scene, event_count_at(scene, time_s(-1)));
  PresentThings const now = after_events(scene, event_count_at(scene, time_s(0)));
  for (std::size_t i = 0; i < now.size(); ++i) {
    SceneThing const& thing = scene.things[i];
    bool const moving =
        before[i].has_value() && now[i].has_value() && moves(thing, time_s(-1), time_s(0));
    bool const begins = number(index) == 1 || !moves(thing, time_s(-2), time_s(-1));
    if (moving && (begins || !moves(thing, time_s(0), time_s(1)))) {
      moved.push_back(i);
    }
  }
  return moved;
}

}  // namespace credo
