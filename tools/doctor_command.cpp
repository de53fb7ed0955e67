#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "config_arguments.hpp"
#include "core/error.hpp"
#include "doctor/computer.hpp"
#include "doctor/listed_findings.hpp"
#include "doctor/openni_install.hpp"
#include "doctor/sensor_findings.hpp"
#include "doctor/usb_bus.hpp"
#include "finding_output.hpp"
#include "openni/openni_sensor.hpp"

namespace credo {
namespace {

constexpr char const* kExamples = R"(Examples:
  credo doctor                                     the first sensor that OpenNI2 finds
  LD_LIBRARY_PATH=build/openni2 credo doctor       with our drivers, without installing them
  credo doctor --source openni:freenect://A00361A00361A --seconds 20
  credo doctor --config my.yaml --set dds.interface=eth0 --json > findings.json

Each line is ok, warning or error, what was looked at and what was found, and below it what to do.
Exit codes: 0 no error, 1 an error, 2 bad usage or config.)";

struct DoctorCommand {
  std::string source = "openni:";
  double seconds = 3.0;
  ConfigArguments config;
  bool json = false;
};

/// One line on stderr that is redrawn; nothing where that is no terminal.
class StatusLine {
public:
  StatusLine() = default;
  StatusLine(StatusLine const&) = delete;
  StatusLine& operator=(StatusLine const&) = delete;
  StatusLine(StatusLine&&) = delete;
  StatusLine& operator=(StatusLine&&) = delete;
  ~StatusLine() { clear(); }

  void show(std::string const& text) {
    if (terminal_) {
      fmt::print(stderr, "\r{}\033[K", text);
      std::fflush(stderr);
      open_ = true;
    }
  }
  void clear() {
    if (open_) {
      fmt::print(stderr, "\r\033[K");
      open_ = false;
    }
  }

private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  bool open_ = false;
};

std::string sensor_uri(std::string const& source) {
  constexpr char const* kScheme = "openni:";
  if (!source.starts_with(kScheme)) {
    throw InputError("--source " + source +
                     ": is no live sensor; write openni: for the first one, or openni:URI (credo "
                     "devices lists them)");
  }
  return source.substr(std::string(kScheme).size());
}

void append(std::vector<Finding>& all, std::vector<Finding> more) {
  std::ranges::move(more, std::back_inserter(all));
}

/// From what OpenNI2 lists to the floor.
void look_at_sensors(DoctorCommand const& command, PipelineConfig const& config,
                     UsbState const& usb, OpenniInstall const& install,
                     std::vector<Finding>& findings) {
  StatusLine status;
  status.show("looking for sensors");
  try {
    OpenniLibrary const library;
    std::vector<SensorInfo> const listed = list_sensors();
    append(findings, listed_findings(listed, usb, install));
    std::string const uri = sensor_uri(command.source);
    if (listed.empty() && uri.empty()) {
      return;
    }
    SensorMeasurement const measured =
        measure_sensor(uri, command.seconds, config.capture, config.sensor,
                       [&](std::string const& what, double s, double of_s) {
                         status.show(fmt::format("{}: {:.1f} of {:.0f} s", what, s, of_s));
                       });
    append(findings, stream_findings(measured));
    if (measured.evidence.views > 0) {
      append(findings, image_findings(measured, config.capture, config.sensor));
      append(findings, floor_findings(measured.evidence, config.pose));
    }
  } catch (InputError const& error) {
    Section section("sensors");
    section.error("opening", error.what(), "see the errors above; then credo doctor again");
    append(findings, section.take());
  }
}

int examine(DoctorCommand const& command) {
  PipelineConfig const config = resolved_config(command.config);
  // Before anything takes its time.
  static_cast<void>(sensor_uri(command.source));
  UsbState const usb = read_usb();
  OpenniInstall const install = read_openni_install(openni_library_file());
  std::vector<Finding> findings =
      openni_findings(install, std::ranges::any_of(usb.devices, &UsbDevice::is_kinect));
  append(findings, usb_findings(usb));
  look_at_sensors(command, config, usb, install, findings);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets variables.
  char const* const cyclone = std::getenv("CYCLONEDDS_URI");
  append(findings, computer_findings(read_computer(), config.dds,
                                     cyclone != nullptr && *cyclone != '\0', try_dds(config.dds)));
  std::cout << (command.json ? findings_json(findings)
                             : findings_text(findings, isatty(STDOUT_FILENO) != 0));
  return is_well(findings) ? 0 : 1;
}

}  // namespace

void add_doctor_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<DoctorCommand>();
  CLI::App* sub = app.add_subcommand(
      "doctor", "Tell whether a live sensor will work here, and what to do where not");
  sub->footer(kExamples);
  sub->add_option("--source", command->source, "openni: or openni:URI")
      ->type_name("URI")
      ->capture_default_str();
  sub->add_option("--seconds", command->seconds, "how long to measure the sensor")
      ->type_name("S")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  add_config_arguments(*sub, command->config);
  sub->add_flag("--json", command->json, "the findings as one JSON object");
  sub->callback([command, &chosen] { chosen = [command] { return examine(*command); }; });
}

}  // namespace credo
