#include <spdlog/fmt/fmt.h>

#include <iostream>
#include <memory>
#include <utility>

#include "commands.hpp"
#include "config_arguments.hpp"
#include "core/error.hpp"
#include "recording.hpp"
#include "source_uri.hpp"
#include "status_line.hpp"
#include "stop_on_signal.hpp"

namespace credo {
namespace {

constexpr char const* kExamples = R"(Examples:
  credo record --source openni: --out data/desk                  (Ctrl-C ends it)
  credo record --source openni:freenect://A00361A00361A --seconds 60 --out data/desk.oni
  credo record --source openni: --frames 300 --set sensor.registration=software --out data/desk
  credo run --source dataset:data/desk --out out/desk

DIR receives a TUM RGB-D folder (depth/ and rgb/ as PNG, depth.txt, rgb.txt, groundtruth.txt,
camera-intrinsics.txt), recording.json and SHA256SUMS; depth is lossless and reads back to the same
frames. FILE.oni, from a sensor alone, is of OpenNI2's recorder, with FILE.oni.sha256 beside it. Both
are verified when they are read, and by sha256sum -c. Depth is recorded to its end, whatever
capture.max_depth_m says, and as the sensor registers it, unless sensor.registration says otherwise.
More: docs/live.md.)";

struct RecordCommand {
  std::string source;
  std::filesystem::path out;
  ConfigArguments config;
  std::optional<std::int64_t> frames;
  std::optional<double> seconds;
};

/// A recording holds all that there is, as it came: whoever reads it decides.
PipelineConfig recording_config(ConfigArguments const& arguments) {
  constexpr double kAllDepth_m = 100.0;
  PipelineConfig config = resolved_config(arguments);
  config.capture.max_depth_m = kAllDepth_m;
  if (config.sensor.registration == RegistrationMode::kAuto) {
    config.sensor.registration = RegistrationMode::kSensor;
  }
  return config;
}

std::string summary(Recorded const& recorded, std::filesystem::path const& out) {
  std::uint64_t lost = 0;
  for (auto const& [reason, count] : recorded.lost) {
    lost += count;
  }
  std::string const text = fmt::format("{} frames, {} lost{}, {:.1f} s", recorded.frames, lost,
                                       counts_text(recorded.lost), recorded.seconds);
  return recorded.frames == 0
             ? text + ": nothing was written\n"
             : fmt::format("{}, {:.1f} MB in {}; play it back: credo run --source {}{}\n", text,
                           static_cast<double>(recorded.bytes) / 1e6, out.string(), recorded.source,
                           recorded.settings);
}

int record(RecordCommand const& command) {
  bool const oni = command.out.extension() == ".oni";
  if (oni && !is_live(command.source)) {
    throw InputError("--out " + command.out.string() +
                     ": only a sensor (--source openni:) is recorded as .oni; name a folder to "
                     "record " +
                     command.source);
  }
  log_to_stderr();
  StopOnSignal const signals;
  RecordingOrder const order{command.source,
                             command.out,
                             command.frames,
                             command.seconds,
                             recording_config(command.config),
                             signals.token()};
  Recorded const recorded = oni ? record_oni(order) : record_folder(order);
  if (recorded.frames == 0 && !signals.token().stop_requested()) {
    throw InputError(command.source + ": not one frame came" + counts_text(recorded.lost) +
                     "; nothing was written");
  }
  std::cout << summary(recorded, command.out) << std::flush;
  return 0;
}

}  // namespace

void add_record_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<RecordCommand>();
  CLI::App* sub = app.add_subcommand("record", "Record a sensor, without loss and with checksums");
  sub->footer(kExamples);
  sub->add_option("--source", command->source,
                  "openni:[URI]; into a folder also dataset:DIR, oni:FILE or sim:NAME-or-FILE")
      ->required()
      ->type_name("URI");
  sub->add_option("--out", command->out, "a new folder, or a new file that ends in .oni")
      ->required()
      ->type_name("DIR|FILE.oni");
  sub->add_option("--frames", command->frames, "stop after so many frames, 1 or more")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  sub->add_option("--seconds", command->seconds, "stop after so long, above 0")
      ->check(CLI::PositiveNumber)
      ->type_name("S");
  add_config_arguments(*sub, command->config);
  sub->callback([command, &chosen] { chosen = [command] { return record(*command); }; });
}

}  // namespace credo
