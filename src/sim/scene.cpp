#include "sim/scene.hpp"

#include <set>
#include <utility>

#include "core/error.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

Field point(std::string name, std::vector<double>& values, std::string text) {
  return {std::move(name), NumbersTarget{&values, 3, 3}, {-1000, 1000}, "m", std::move(text)};
}

Field turn(std::vector<double>& values, std::size_t min_count, std::string text) {
  return {"rpy_deg", NumbersTarget{&values, min_count, 3}, {-360, 360}, "deg", std::move(text)};
}

}  // namespace

FieldList fields(SceneThing& thing) {
  return {
      {"name", &thing.name, {}, "", "unique in the scene"},
      choice("kind", thing.kind, {"floor", "wall", "object", "stuff"}, "what it is to the belief"),
      {"type", &thing.type, {}, "", "of an object: what priors call its model"},
      {"model", &thing.model, {}, "", "name or file of what it looks like; empty = see shape"},
      choice("shape", thing.shape, {"box", "cylinder", "sphere", "table"}, "its primitive"),
      {"size_m",
       NumbersTarget{&thing.size_m, 1, 5},
       {1e-4, 1000},
       "m",
       "box x y z; cylinder radius height; sphere radius; table x y height thickness leg"},
      point("position_m", thing.position_m, "centre of its base in the world"),
      turn(thing.rpy_deg, 3, "turns about the fixed axes x, y, z"),
      list_of("path", thing.path, "where it moves, in order of time; empty = it stands"),
      {"color", NumbersTarget{&thing.color, 3, 3}, {0, 255}, "", "red, green, blue"},
      section("texture", fields(thing.texture), "a pattern in its colour"),
      {"checker_m", &thing.checker_m, {0, 10}, "m", "short for texture: a checker of this size_m"},
      choice("surface", thing.surface, {"matte", "dark", "shiny", "glass"},
             "how it returns the light of a depth camera; glass returns none"),
  };
}

FieldList fields(SceneTexture& texture) {
  return {
      choice("kind", texture.kind, {"plain", "checker", "stripes", "noise"}, "its pattern"),
      {"size_m", &texture.size_m, {1e-3, 100}, "m", "of a square, a stripe, a blotch"},
  };
}

FieldList fields(ThingWaypoint& waypoint) {
  return {
      {"time_s", &waypoint.time_s, {0, 86400}, "s", "when, on the clock of the camera's path"},
      point("position_m", waypoint.position_m, "where the centre of its base is then"),
      {"yaw_deg", &waypoint.yaw_deg, {-3600, 3600}, "deg", "its turn about z, beyond rpy_deg"},
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
      choice("what", event.what, {"appeared", "moved", "removed", "swapped"}, "what happens to it"),
      {"with", &event.with, {}, "", "of a swap: name of the thing that it trades places with"},
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
