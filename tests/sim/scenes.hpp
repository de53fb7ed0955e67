#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/scene.hpp"

namespace credo::test {

/// A thing with a name; the other members as they come.
inline SceneThing thing(std::string name, SceneShape shape, std::vector<double> size_m,
                        std::vector<double> position_m = {0, 0, 0}) {
  SceneThing result;
  result.name = std::move(name);
  result.shape = shape;
  result.size_m = std::move(size_m);
  result.position_m = std::move(position_m);
  return result;
}

/// A known object with a name and a type.
inline SceneThing object(std::string name, std::string type, SceneShape shape,
                         std::vector<double> size_m, std::vector<double> position_m) {
  SceneThing result = thing(std::move(name), shape, std::move(size_m), std::move(position_m));
  result.kind = SceneKind::kObject;
  result.type = std::move(type);
  return result;
}

/// 64 x 48 pixels, looking along +x from 1 m above the origin, at rest.
inline Scene small_scene(std::vector<SceneThing> things) {
  Scene scene;
  scene.name = "test";
  scene.things = std::move(things);
  scene.camera.width_px = 64;
  scene.camera.height_px = 48;
  scene.camera.fx_px = 60.0;
  scene.camera.fy_px = 62.0;
  scene.camera.cx_px = 31.5;
  scene.camera.cy_px = 23.5;
  scene.camera.path = {{0.0, {0, 0, 1}, {1, 0, 1}}};
  return scene;
}

}  // namespace credo::test
