#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/fields.hpp"

namespace credo::test {

enum class Pace : std::uint8_t { kOff, kSlow, kFast };

struct ThingConfig {
  std::string name = "thing";
  std::vector<double> size_m = {1, 1, 1};
};
inline FieldList fields(ThingConfig& config) {
  return {
      {"name", &config.name, {}, "", "what it is called"},
      {"size_m", NumbersTarget{&config.size_m, 1, 3}, {0, 10}, "m", "edge lengths"},
  };
}

/// One field of every kind.
struct KitchenConfig {
  bool enabled = true;
  int window_px = 9;
  int any_number = 0;
  float max_jump_m = 0.02F;
  double gain = 1.0;
  std::string file;
  Pace pace = Pace::kSlow;
  std::vector<double> position = {1, 2, 3};
  std::vector<ThingConfig> things;
};
inline FieldList fields(KitchenConfig& config) {
  FieldList normals = {
      {"window_px", &config.window_px, {3, 99}, "px", "side of the window"},
      {"max_jump_m", &config.max_jump_m, {0, 0.1}, "m", "largest step on a surface"},
      {"enabled", &config.enabled, {}, "", "whether to look at all"},
  };
  return {
      section("normals", std::move(normals), "surface normals"),
      {"any_number", &config.any_number, {}, "", "a number without a range"},
      {"gain", &config.gain, {0}, "", "how loud"},
      {"file", &config.file, {}, "", "a file's name"},
      choice("pace", config.pace, {"off", "slow", "fast"}, "how quick"),
      {"position", NumbersTarget{&config.position, 3, 3}, {}, "m", "where it stands"},
      list_of("things", config.things, "what stands there"),
  };
}

}  // namespace credo::test
