#include "drivers/virtual/sensor_script.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "drivers/virtual/fault_script.hpp"
#include "io/json_value.hpp"

namespace credo {
namespace {

constexpr double kMaxRate_hz = 1000.0;

std::string name_of(JsonValue const& value) {
  std::string name = value.text();
  bool const plain = std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
  if (!plain || name.size() > 64) {
    value.refuse("must be up to 64 letters, digits, '-', '_' or '.': it is part of a URI");
  }
  return name;
}

PlayMode play_of(JsonValue const& value) {
  return chosen<PlayMode>(
      value,
      {{"loop", PlayMode::kLoop}, {"ping_pong", PlayMode::kPingPong}, {"once", PlayMode::kOnce}});
}

SensorScript sensor_of(JsonValue const& value, std::filesystem::path const& folder) {
  value.must_be_object(
      {"name", "dataset", "rate_hz", "color_rate_hz", "play", "cache_mb", "report", "faults"});
  SensorScript sensor;
  sensor.name = name_of(value.at("name"));
  sensor.dataset = folder / value.at("dataset").text();
  if (value.has("rate_hz")) {
    sensor.depth_rate_hz = number_within(value.at("rate_hz"), 0.1, kMaxRate_hz, "Hz");
  }
  sensor.color_rate_hz = value.has("color_rate_hz")
                             ? number_within(value.at("color_rate_hz"), 0.1, kMaxRate_hz, "Hz")
                             : sensor.depth_rate_hz;
  if (value.has("play")) {
    sensor.play = play_of(value.at("play"));
  }
  if (value.has("cache_mb")) {
    sensor.cache_mb = static_cast<std::size_t>(number_within(value.at("cache_mb"), 1, 65536, "MB"));
  }
  sensor.reports = value.has("report") && value.at("report").flag();
  if (value.has("faults")) {
    value.at("faults").for_each([&](JsonValue const& fault) { add_fault(fault, sensor); });
  }
  return sensor;
}

}  // namespace

std::vector<SensorScript> read_sensor_script(std::filesystem::path const& path) {
  std::vector<SensorScript> sensors;
  read_json_file(path, "scripts of virtual sensors", [&](JsonValue const& script) {
    script.must_be_object({"sensors"});
    JsonValue const list = script.at("sensors");
    list.for_each([&](JsonValue const& value) {
      SensorScript sensor = sensor_of(value, path.parent_path());
      if (std::ranges::find(sensors, sensor.name, &SensorScript::name) != sensors.end()) {
        value.at("name").refuse("is taken by a sensor before; give each its own");
      }
      sensors.push_back(std::move(sensor));
    });
    if (sensors.empty()) {
      list.refuse("must name at least one sensor");
    }
  });
  return sensors;
}

}  // namespace credo
