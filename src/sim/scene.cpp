#include "sim/scene.hpp"

#include <algorithm>
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

}  // namespace

FieldList fields(SceneThing& thing) {
  return {
      {"name", &thing.name, {}, "", "unique in the scene"},
      choice("kind", thing.kind, {"floor", "wall", "object", "stuff"}, "what it is to the belief"),
      choice("shape", thing.shape, {"box", "cylinder", "sphere", "table"}, "its primitive"),
      {"size_m",
       NumbersTarget{&thing.size_m, 1, 5},
       {1e-4, 1000},
       "m",
       "box x y z; cylinder radius height; sphere radius; table x y height thickness leg"},
      point("position_m", thing.position_m, "centre of its base in the world"),
      {"rpy_deg",
       NumbersTarget{&thing.rpy_deg, 3, 3},
       {-360, 360},
       "deg",
       "turns about the fixed axes x, y, z"},
      {"color", NumbersTarget{&thing.color, 3, 3}, {0, 255}, "", "red, green, blue"},
      {"checker_m", &thing.checker_m, {0, 10}, "m", "side of a checkerboard's squares; 0 = plain"},
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
      list_of("path", camera.path, "waypoints in order of time"),
  };
}

FieldList fields(Scene& scene) {
  return {
      list_of("things", scene.things, "what stands in the world, the floor and walls too"),
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
