#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "sim/scene.hpp"

namespace credo {
namespace {

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

[[noreturn]] void refuse(Scene const& scene, std::string const& what) {
  throw InputError("scene " + scene.name + ": " + what);
}

void check_size(Scene const& scene, SceneThing const& thing) {
  std::size_t const needed = size_count(thing.shape);
  if (thing.size_m.size() != needed) {
    refuse(scene, thing.name + ": its shape needs " + std::to_string(needed) +
                      " numbers in size_m, has " + std::to_string(thing.size_m.size()));
  }
  if (std::any_of(thing.size_m.begin(), thing.size_m.end(), [](double s) { return !(s > 0); })) {
    refuse(scene, thing.name + ": every number of size_m must be positive");
  }
}

void check_thing(Scene const& scene, SceneThing const& thing) {
  if (thing.model.empty()) {
    check_size(scene, thing);
  } else if (!thing.size_m.empty()) {
    refuse(scene, thing.name + ": its model says how large it is, leave out size_m");
  } else if (thing.loaded_model == nullptr) {
    refuse(scene, thing.name + ": its model " + thing.model + " was not loaded");
  }
  if (thing.checker_m > 0.0 && thing.texture.kind != SceneTexture::Kind::kPlain) {
    refuse(scene, thing.name + ": give checker_m or texture, not both");
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

void check_thing_path(Scene const& scene, SceneThing const& thing) {
  if (thing.path.empty()) {
    return;
  }
  if (thing.position_m != SceneThing{}.position_m) {
    refuse(scene, thing.name + ": its path says where it is, leave out position_m");
  }
  for (std::size_t i = 1; i < thing.path.size(); ++i) {
    if (!(thing.path[i].time_s > thing.path[i - 1].time_s)) {
      refuse(scene, thing.name + ": path[" + std::to_string(i) + "]: time_s must rise");
    }
  }
}

/// The thing of that name, which must be in the scene.
SceneThing const& named_thing(Scene const& scene, std::string const& name,
                              std::string const& where) {
  auto const found = std::find_if(scene.things.begin(), scene.things.end(),
                                  [&](SceneThing const& thing) { return thing.name == name; });
  if (found == scene.things.end()) {
    refuse(scene, where + "there is no thing '" + name + "'");
  }
  return *found;
}

void check_place(Scene const& scene, SceneEvent const& event, std::string const& where) {
  bool const has_none = event.what == SceneChange::kRemoved || event.what == SceneChange::kSwapped;
  for (auto const& [name, numbers] :
       {std::pair("position_m", &event.position_m), std::pair("rpy_deg", &event.rpy_deg)}) {
    if (!numbers->empty() && numbers->size() != 3) {
      refuse(scene, where + name + " needs 0 or 3 numbers, has " + std::to_string(numbers->size()));
    }
    if (!numbers->empty() && has_none) {
      bool const swapped = event.what == SceneChange::kSwapped;
      refuse(scene, where + "what is " + (swapped ? "swapped" : "removed") + " has no " + name);
    }
  }
  if (event.what == SceneChange::kMoved && event.position_m.empty()) {
    refuse(scene, where + "what is moved needs position_m");
  }
}

/// A path says where its thing is: no event may say otherwise.
void check_pathless(Scene const& scene, SceneEvent const& event, SceneThing const& thing,
                    std::string const& where) {
  if (thing.path.empty()) {
    return;
  }
  if (event.what == SceneChange::kMoved || event.what == SceneChange::kSwapped) {
    refuse(scene, where + thing.name + " has a path, it cannot be moved or swapped");
  }
  if (!event.position_m.empty() || !event.rpy_deg.empty()) {
    refuse(scene, where + thing.name + " has a path, it appears where that has it");
  }
}

/// What an event says, whatever came before it. `where` begins the line.
void check_words(Scene const& scene, SceneEvent const& event, std::string const& where) {
  if (!(event.time_s >= 0.0)) {
    refuse(scene, where + "time_s must not be negative");
  }
  check_pathless(scene, event, named_thing(scene, event.thing, where), where);
  if (event.what == SceneChange::kSwapped) {
    check_pathless(scene, event, named_thing(scene, event.with, where), where);
    if (event.with == event.thing) {
      refuse(scene, where + event.thing + " cannot trade places with itself");
    }
  } else if (!event.with.empty()) {
    refuse(scene, where + "only what is swapped is so with another thing");
  }
  check_place(scene, event, where);
}

/// Follows the things from event to event.
class EventOrder {
public:
  explicit EventOrder(Scene const& scene) : scene_(scene) {}

  /// Takes the next event to `name`, one of its things.
  void take(SceneEvent const& event, std::string const& name, std::string const& where) {
    bool const appears = event.what == SceneChange::kAppeared;
    auto const [state, is_first] = states_.insert({name, {!appears, event.time_s}});
    if (event.time_s < last_s_ || (!is_first && event.time_s == state->second.time_s)) {
      refuse(scene_, where + "time_s must rise, only different things may share a time");
    }
    if (appears == state->second.present) {
      refuse(scene_, where + name +
                         (appears ? " is there already, it cannot appear"
                                  : " is absent, it cannot be moved, swapped or removed"));
    }
    state->second = {event.what != SceneChange::kRemoved, event.time_s};
    last_s_ = event.time_s;
  }

private:
  struct State {
    bool present;
    double time_s;
  };
  Scene const& scene_;
  std::map<std::string, State> states_;
  double last_s_ = 0.0;
};

/// That each event can follow those before it.
void check_events(Scene const& scene) {
  EventOrder order(scene);
  for (std::size_t i = 0; i < scene.events.size(); ++i) {
    SceneEvent const& event = scene.events[i];
    std::string const where = "events[" + std::to_string(i) + "]: ";
    check_words(scene, event, where);
    order.take(event, event.thing, where);
    if (event.what == SceneChange::kSwapped) {
      order.take(event, event.with, where);
    }
  }
}

}  // namespace

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
    check_thing_path(scene, thing);
  }
  check_path(scene);
  check_events(scene);
}

}  // namespace credo
