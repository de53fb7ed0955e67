#include "scene_file.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "config/yaml_config.hpp"
#include "model_files.hpp"

namespace credo {

Scene load_scene(std::string const& name_or_file) {
  Scene scene;
  scene.name = name_or_file;
  std::filesystem::path const path = find_scene(name_or_file);
  load_config(fields(scene), {path}, {});
  std::map<std::string, std::shared_ptr<ObjectModel const>> models;
  // That an open mesh has no inside matters to beliefs only: a camera sees it from both sides.
  std::vector<std::string> not_told;
  for (SceneThing& thing : scene.things) {
    if (thing.model.empty()) {
      continue;
    }
    std::shared_ptr<ObjectModel const>& model = models[thing.model];
    if (model == nullptr) {
      model = std::make_shared<ObjectModel const>(load_model(
          find_model(thing.model, path, path.string() + ": thing " + thing.name), not_told));
    }
    thing.loaded_model = model;
  }
  return scene;
}

}  // namespace credo
