#pragma once

#include <map>
#include <string>

#include "drivers/virtual/sensor_script.hpp"
#include "io/json_value.hpp"

namespace credo {

// The parts of reading a sensor's script that its faults need. All throw as JsonValue does.

/// A number in [low, high].
double number_within(JsonValue const& value, double low, double high, char const* unit);

/// What a word of a fixed list stands for.
template <typename T>
T chosen(JsonValue const& value, std::map<std::string, T> const& words) {
  auto const found = words.find(value.text());
  if (found == words.end()) {
    std::string known;
    for (auto const& [word, unused] : words) {
      known += (known.empty() ? "" : ", ") + word;
    }
    value.refuse("'" + value.text() + "' is unknown; known are " + known);
  }
  return found->second;
}

/// Reads one element of a sensor's `faults`. The sensor's rate must be known: times may be given as
/// frame numbers.
void add_fault(JsonValue const& value, SensorScript& sensor);

}  // namespace credo
