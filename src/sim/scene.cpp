#include "sim/scene.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

std::size_t size_count(SceneShape shape) {
  switch (shape) {
    case SceneShape::kBox:
      return 3;
    case SceneShape::kCylinder:
      return 2;
    case SceneShape::kSphere:
      return 1;
    case SceneShape::kTable:
      return 5;
  }
  return 0;
}

Field point(std::string name, std::vector<double>& values, std::string text) {
  return {std::move(name), NumbersTarget{&values, 3, 3}, {-1000, 1000}, "m", std::move(text)};
}

Field turn(std::vector<double>& values, std::size_t min_count, std::string text) {
  return {"rpy_deg", NumbersTarget{&values, min_count, 3}, {-360, 360}, "deg", std::move(text)};
}

[[noreturn]] void refuse(Scene const& scene, std::string const& what) {
  throw InputError("scene " + scene.name + ": " + what);
}

void check_thing(Scene const& scene, SceneThing const& thing) {
  std::size_t const needed = size_count(thing.shape);
  if (thing.size_m.size() != needed) {
    refuse(scene, thing.name + ": its shape needs " + std::to_string(needed) +
                      " numbers in size_m, has " + std::to_string(thing.size_m.size()));
  }
  if (std::any_of(thing.size_m.begin(), thing.size_m.end(), [](double s) { return !(s > 0); })) {
    refuse(scene, thing.name + ": every number of size_m must be positive");
  }
  if (!thing.type.empty() && thing.kind != SceneKind::kObject) {
    refuse(scene, thing.name + ": only a thing of kind object has a type");
  }
}

void check_path(Scene const& scene) {
  auto const& path = scene.camera.path;
  if (path.empty()) {
    refuse(scene, "camera.path needs at least one waypoint");
  }
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i].position_m == path[i].look_at_m) {
      refuse(scene, "camera.path[" + std::to_string(i) + "] looks at where it is");
    }
    if (i > 0 && !(path[i].time_s > path[i - 1].time_s)) {
      refuse(scene, "camera.path[" + std::to_string(i) + "]: time_s must rise");
    }
  }
}

/// What an event says, whatever came before it. `where` begins the line.
void check_words(Scene const& scene, SceneEvent const& event, std::string const& where) {
  if (!(event.time_s >= 0.0)) {
    refuse(scene, where + "time_s must not be negative");
  }
  if (std::none_of(scene.things.begin(), scene.things.end(),
                   [&](SceneThing const& thing) { return thing.name == event.thing; })) {
    refuse(scene, where + "there is no thing '" + event.thing + "'");
  }
  for (auto const& [name, numbers] :
       {std::pair("position_m", &event.position_m), std::pair("rpy_deg", &event.rpy_deg)}) {
    if (!numbers->empty() && numbers->size() != 3) {
      refuse(scene, where + name + " needs 0 or 3 numbers, has " + std::to_string(numbers->size()));
    }
    if (!numbers->empty() && event.what == SceneChange::kRemoved) {
      refuse(scene, where + "what is removed has no " + name);
    }
  }
  if (event.what == SceneChange::kMoved && event.position_m.empty()) {
    refuse(scene, where + "what is moved needs position_m");
  }
}

/// That each event can follow those before it.
void check_events(Scene const& scene) {
  struct State {
    bool present;
    double time_s;
  };
  std::map<std::string, State> states;
  double last_s = 0.0;
  for (std::size_t i = 0; i < scene.events.size(); ++i) {
    SceneEvent const& event = scene.events[i];
    std::string const where = "events[" + std::to_string(i) + "]: ";
    check_words(scene, event, where);
    bool const appears = event.what == SceneChange::kAppeared;
    auto const [state, is_first] = states.insert({event.thing, {!appears, event.time_s}});
    if (event.time_s < last_s || (!is_first && event.time_s == state->second.time_s)) {
      refuse(scene, where + "time_s must rise, only different things may share a time");
    }
    if (appears == state->second.present) {
      refuse(scene, where + event.thing +
                        (appears ? " is there already, it cannot appear"
                                 : " is absent, it cannot be moved or removed"));
    }
    state->second = {event.what != SceneChange::kRemoved, event.time_s};
    last_s = event.time_s;
  }
}

}  // namespace

FieldList fields(SceneThing& thing) {
  return {
      {"name", &thing.name, {}, "", "unique in the scene"},
      choice("kind", thing.kind, {"floor", "wall", "object", "stuff"}, "what it is to the belief"),
      {"type", &thing.type, {}, "", "of an object: its model's name; empty = its own name"},
      choice("shape", thing.shape, {"box", "cylinder", "sphere", "table"}, "its primitive"),
      {"size_m",
       NumbersTarget{&thing.size_m, 1, 5},
       {1e-4, 1000},
       "m",
       "box x y z; cylinder radius height; sphere radius; table x y height thickness leg"},
      point("position_m", thing.position_m, "centre of its base in the world"),
      turn(thing.rpy_deg, 3, "turns about the fixed axes x, y, z"),
      {"color", NumbersTarget{&thing.color, 3, 3}, {0, 255}, "", "red, green, blue"},
      {"checker_m", &thing.checker_m, {0, 10}, "m", "side of a checkerboard's squares; 0 = plain"},
      choice("surface", thing.surface, {"matte", "dark", "shiny", "glass"},
             "how it returns the light of a depth camera; glass returns none"),
  };
}

FieldList fields(SceneWaypoint& waypoint) {
  return {
      {"time_s", &waypoint.time_s, {0, 86400}, "s", "when"},
      point("position_m", waypoint.position_m, "where the camera is"),
      point("look_at_m", waypoint.look_at_m, "what is in the middle of its picture"),
  };
}

FieldList fields(SceneCamera& camera) {
  return {
      {"width_px", &camera.width_px, {1, 4096}, "px", "image width"},
      {"height_px", &camera.height_px, {1, 4096}, "px", "image height"},
      {"fx_px", &camera.fx_px, {1, 1e5}, "px", "horizontal focal length"},
      {"fy_px", &camera.fy_px, {1, 1e5}, "px", "vertical focal length"},
      {"cx_px", &camera.cx_px, {-1e5, 1e5}, "px", "principal point, column"},
      {"cy_px", &camera.cy_px, {-1e5, 1e5}, "px", "principal point, row"},
      {"frames_per_s", &camera.frames_per_s, {0.1, 1000}, "1/s", "frame rate"},
      {"min_range_m", &camera.min_range_m, {0, 100}, "m", "nearer depth is not measured"},
      {"max_range_m", &camera.max_range_m, {0.1, 1000}, "m", "farther depth is not measured"},
      choice("sensor", camera.sensor, {"ideal", "gaussian", "disparity"},
             "how it measures depth; sim.sensor may choose another"),
      {"pose_jitter_m", &camera.pose_jitter_m, {0, 1}, "m", "error of each told position, sigma"},
      {"pose_jitter_rad", &camera.pose_jitter_rad, {0, 1}, "rad", "the same of each told turn"},
      {"pose_drift_m_per_s",
       &camera.pose_drift_m_per_s,
       {0, 1},
       "m/s",
       "how fast told positions stray along x and y"},
      {"pose_drift_rad_per_s",
       &camera.pose_drift_rad_per_s,
       {0, 1},
       "rad/s",
       "how fast told headings stray"},
      list_of("path", camera.path, "waypoints in order of time"),
  };
}

FieldList fields(SceneEvent& event) {
  return {
      {"time_s", &event.time_s, {0, 86400}, "s", "when, on the clock of the camera's path"},
      {"thing", &event.thing, {}, "", "name of the thing"},
      choice("what", event.what, {"appeared", "moved", "removed"}, "what happens to it"),
      {"position_m",
       NumbersTarget{&event.position_m, 0, 3},
       {-1000, 1000},
       "m",
       "where it stands from then on; empty = its own"},
      turn(event.rpy_deg, 0, "how it is turned from then on; empty = as it was"),
  };
}

FieldList fields(Scene& scene) {
  return {
      list_of("things", scene.things, "what stands in the world, the floor and walls too"),
      list_of("events", scene.events, "what changes, in order of time"),
      section("camera", fields(scene.camera), "the sensor and its way"),
  };
}

void check_scene(Scene const& scene) {
  if (scene.things.empty()) {
    refuse(scene, "has no things");
  }
  std::set<std::string> names;
  for (SceneThing const& thing : scene.things) {
    if (thing.name.empty() || !names.insert(thing.name).second) {
      refuse(scene, "every thing needs a name of its own, '" + thing.name + "' is not");
    }
    check_thing(scene, thing);
  }
  check_path(scene);
  check_events(scene);
}

fs::path find_scene(std::string const& name_or_file) {
  if (fs::is_regular_file(name_or_file)) {
    return name_or_file;
  }
  fs::path const folder = CREDO_SCENES_DIR;
  fs::path named = folder / (name_or_file + ".yaml");
  if (name_or_file.find('/') == std::string::npos && fs::is_regular_file(named)) {
    return named;
  }
  std::set<std::string> known;
  std::error_code ignored;
  for (auto const& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".yaml") {
      known.insert(entry.path().stem().string());
    }
  }
  std::string names;
  for (std::string const& name : known) {
    names += (names.empty() ? "" : ", ") + name;
  }
  throw InputError("sim:" + name_or_file + ": no such scene or file; scenes are " + names);
}

}  // namespace credo
