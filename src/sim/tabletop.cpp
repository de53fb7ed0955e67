#include "sim/tabletop.hpp"

#include <array>
#include <cstddef>
#include <iomanip>
#include <memory>
#include <sstream>

#include "core/error.hpp"

namespace credo {
namespace {

constexpr std::array<char const*, 3> kShapeNames = {"box", "cylinder", "sphere"};
constexpr std::array<std::size_t, 3> kSizeCounts = {3, 2, 1};

std::string decimals(double value, int places) {
  std::ostringstream text;
  text << ' ' << std::fixed << std::setprecision(places) << value;
  return text.str();
}

std::string numbers(Eigen::Vector3d const& values, int places) {
  return decimals(values.x(), places) + decimals(values.y(), places) + decimals(values.z(), places);
}

std::string line_of(TabletopThing const& thing) {
  std::string line = "object " + thing.model;
  if (thing.model.empty()) {
    line = std::string("unknown ") + kShapeNames.at(static_cast<std::size_t>(thing.shape));
    for (double const size_m : thing.size_m) {
      line += decimals(size_m, 4);
    }
  }
  return line + numbers(thing.position_m, 4) + numbers(thing.rpy_deg, 2) + "\n";
}

/// Reads the lines of a file of scenes.
class Reader {
public:
  Reader(std::string const& text, std::string const& where) : lines_(text), where_(where) {}

  std::vector<TabletopScene> scenes() {
    for (std::string line; std::getline(lines_, line);) {
      ++number_;
      if (!line.empty() && line.front() != '#') {
        read(line);
      }
    }
    return std::move(scenes_);
  }

private:
  [[noreturn]] void refuse(std::string const& why) const {
    throw InputError(where_ + ":" + std::to_string(number_) + ": " + why);
  }

  void read(std::string const& line) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "scene") {
      TabletopScene& scene = scenes_.emplace_back();
      words >> scene.name >> scene.seed;
    } else if (scenes_.empty()) {
      refuse("a scene must come before '" + kind + "'");
    } else if (kind == "view") {
      TabletopScene& scene = scenes_.back();
      take(words, scene.camera_m);
      take(words, scene.look_at_m);
      words >> scene.wall_y_m;
    } else if (kind == "object" || kind == "unknown") {
      scenes_.back().things.push_back(thing(kind, words));
    } else {
      refuse("unknown word '" + kind + "'; scene, view, object or unknown");
    }
    std::string rest;
    if (words.fail() || words >> rest) {
      refuse("not the numbers that '" + kind + "' has");
    }
  }

  TabletopThing thing(std::string const& kind, std::istringstream& words) const {
    TabletopThing result;
    std::string word;
    words >> word;
    if (kind == "object") {
      result.model = word;
    } else {
      std::size_t shape = 0;
      while (shape < kShapeNames.size() && kShapeNames.at(shape) != word) {
        ++shape;
      }
      if (shape == kShapeNames.size()) {
        refuse("unknown shape '" + word + "'; box, cylinder or sphere");
      }
      result.shape = static_cast<SceneShape>(shape);
      result.size_m.resize(kSizeCounts.at(shape));
      for (double& size_m : result.size_m) {
        words >> size_m;
      }
    }
    take(words, result.position_m);
    take(words, result.rpy_deg);
    return result;
  }

  static void take(std::istringstream& words, Eigen::Vector3d& values) {
    words >> values.x() >> values.y() >> values.z();
  }

  std::istringstream lines_;
  std::string where_;
  int number_ = 0;
  std::vector<TabletopScene> scenes_;
};

SceneThing body(std::string name, SceneKind kind, SceneShape shape, std::vector<double> size_m,
                std::vector<double> position_m, std::vector<double> color) {
  SceneThing thing;
  thing.name = std::move(name);
  thing.kind = kind;
  thing.shape = shape;
  thing.size_m = std::move(size_m);
  thing.position_m = std::move(position_m);
  thing.color = std::move(color);
  return thing;
}

std::vector<double> listed(Eigen::Vector3d const& v) {
  return {v.x(), v.y(), v.z()};
}

/// Told apart by eye: colours around the circle.
std::vector<double> color_of(std::size_t i) {
  static std::vector<std::vector<double>> const colors = {
      {200, 60, 50},  {60, 120, 200}, {70, 160, 80},   {220, 190, 60},
      {150, 80, 160}, {210, 130, 60}, {230, 230, 225}, {90, 190, 190}};
  return colors[i % colors.size()];
}

SceneThing scene_thing(TabletopThing const& thing, std::size_t i, std::string const& scene,
                       ObjectModels const& models) {
  std::string const name = thing.model.empty() ? "unknown " + std::to_string(i) : thing.model;
  SceneThing result = body(name, thing.model.empty() ? SceneKind::kStuff : SceneKind::kObject,
                           thing.shape, thing.size_m, listed(thing.position_m), color_of(i));
  result.rpy_deg = listed(thing.rpy_deg);
  if (!thing.model.empty()) {
    auto const model = models.find(thing.model);
    if (model == models.end()) {
      throw InputError("scene " + scene + ": there is no model '" + thing.model + "'");
    }
    result.model = thing.model;
    result.loaded_model = std::make_shared<ObjectModel const>(model->second);
  }
  return result;
}

}  // namespace

std::string text_of(std::vector<TabletopScene> const& scenes) {
  std::string text =
      "# scene NAME SEED / view CAMERA LOOK_AT WALL_Y / object MODEL POSITION RPY_DEG /\n"
      "# unknown SHAPE SIZE POSITION RPY_DEG; metres\n";
  for (TabletopScene const& scene : scenes) {
    text += "scene " + scene.name + " " + std::to_string(scene.seed) + "\nview" +
            numbers(scene.camera_m, 4) + numbers(scene.look_at_m, 4) + decimals(scene.wall_y_m, 4) +
            "\n";
    for (TabletopThing const& thing : scene.things) {
      text += line_of(thing);
    }
  }
  return text;
}

std::vector<TabletopScene> scenes_in(std::string const& text, std::string const& where) {
  return Reader(text, where).scenes();
}

Scene scene_of(TabletopScene const& tabletop, ObjectModels const& models) {
  Scene scene;
  scene.name = tabletop.name;
  scene.things.push_back(body("floor", SceneKind::kGround, SceneShape::kBox, {12, 12, 0.05},
                              {0, 0, -0.05}, {140, 135, 125}));
  scene.things.push_back(body("wall", SceneKind::kWall, SceneShape::kBox, {12, 0.1, 2.6},
                              {0, tabletop.wall_y_m + 0.05, 0}, {205, 200, 190}));
  scene.things.push_back(body("table", SceneKind::kStuff, SceneShape::kTable,
                              {kTabletopWidth_m, kTabletopDepth_m, kTabletopHeight_m, 0.03, 0.05},
                              {0, 0, 0}, {165, 120, 80}));
  for (std::size_t i = 0; i < tabletop.things.size(); ++i) {
    scene.things.push_back(scene_thing(tabletop.things[i], i, tabletop.name, models));
  }
  scene.camera.sensor = SensorModel::kDisparity;
  scene.camera.path = {{0.0, listed(tabletop.camera_m), listed(tabletop.look_at_m)}};
  return scene;
}

}  // namespace credo
