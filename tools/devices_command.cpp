#include <spdlog/fmt/fmt.h>

#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "commands.hpp"
#include "openni/openni_sensor.hpp"
#include "openni/sensor_list.hpp"

namespace credo {
namespace {

constexpr char const* kExamples = R"(Examples:
  credo devices
  LD_LIBRARY_PATH=build/openni2 credo devices      with our drivers, without installing them
  credo run --source openni:URI --config config/live.yaml --out out/live

A sensor that is plugged in and not listed has no driver, or may not be opened: docs/live.md.)";

/// "640x480 at 30 Hz (1 mm), ...", each once.
std::string modes_text(std::vector<SensorMode> const& modes) {
  std::set<std::string> known;
  std::string text;
  for (SensorMode const& mode : modes) {
    std::string const one = fmt::format("{}x{} at {} Hz ({})", mode.width_px, mode.height_px,
                                        mode.rate_hz, mode.format);
    if (known.insert(one).second) {
      text += (text.empty() ? "" : ", ") + one;
    }
  }
  return text.empty() ? "none" : text;
}

void print(SensorInfo const& sensor) {
  std::cout << fmt::format("{}  {} {} ({:04x}:{:04x})\n", sensor.uri, sensor.vendor, sensor.name,
                           sensor.usb_vendor, sensor.usb_product);
  if (!sensor.trouble.empty()) {
    std::cout << "  cannot be opened: " << sensor.trouble << '\n';
    return;
  }
  std::cout << "  depth         " << modes_text(sensor.depth_modes) << '\n'
            << "  colour        " << modes_text(sensor.color_modes) << '\n'
            << "  registration  "
            << (sensor.registers ? "by the sensor" : "not by the sensor: by credo") << '\n';
}

int list_devices() {
  OpenniLibrary const library;
  std::vector<SensorInfo> const sensors = list_sensors();
  if (sensors.empty()) {
    std::cerr << "no sensor: is one plugged in, of a kind that OpenNI2 has a driver for, and may "
                 "you open it? docs/live.md says what each needs\n";
    return 1;
  }
  for (SensorInfo const& sensor : sensors) {
    print(sensor);
  }
  return 0;
}

}  // namespace

void add_devices_command(CLI::App& app, Command& chosen) {
  CLI::App* sub = app.add_subcommand("devices", "List the sensors that OpenNI2 sees");
  sub->footer(kExamples);
  sub->callback([&chosen] { chosen = [] { return list_devices(); }; });
}

}  // namespace credo
