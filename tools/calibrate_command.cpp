#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "calibration_text.hpp"
#include "commands.hpp"
#include "config_arguments.hpp"
#include "core/error.hpp"
#include "io/calibration_picture.hpp"
#include "io/image.hpp"
#include "source_uri.hpp"
#include "stages/capture/calibration.hpp"
#include "stages/capture/level.hpp"
#include "stop_on_signal.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr char const* kExamples = R"(Examples:
  credo calibrate --source openni: --out hall.yaml --picture hall.png
  credo calibrate --source openni: --wall --out hall.yaml           world x = 0 is the wall in view
  credo calibrate --source dataset:recordings/room --frames 100 --out room.yaml
  credo run --source openni: --config config/live.yaml --config hall.yaml --out out/hall

The camera stands still, with the floor in view. FILE.yaml is an overlay of the config: pose.level:
given and the camera's pitch, roll, height and, with --wall, yaw and place. What exists already is
not overwritten. docs/live.md tells more.)";

struct CalibrateCommand {
  std::string source;
  ConfigArguments config;
  int frames = 30;
  bool wall = false;
  fs::path out;
  fs::path picture;
};

/// Nobody wants to learn after the last frame that there is nowhere to write.
void check_new_file(char const* option, fs::path const& path) {
  if (fs::exists(path)) {
    throw InputError(
        fmt::format("{} {}: exists; name another file, or remove it first", option, path.string()));
  }
  fs::path const folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) {
    throw InputError(fmt::format("{} {}: no folder {}", option, path.string(), folder.string()));
  }
}

void show_progress(int done, int all) {
  if (isatty(STDERR_FILENO) != 0) {
    std::cerr << fmt::format("\rframe {}/{}{}", done, all, done == all ? "\n" : "") << std::flush;
  }
}

/// A pose source that tells other than that the camera stands still contradicts what is asked for.
void check_still(FramePtr const& first, FramePtr const& frame) {
  constexpr double kMost_m = 0.01;
  constexpr double kMost_deg = 0.5;
  Se3 const motion = first->T_source_camera.inverse() * frame->T_source_camera;
  double const turn_deg = so3_log(motion.rotation()).norm() * 180.0 / std::numbers::pi;
  if (motion.translation().norm() > kMost_m || turn_deg > kMost_deg) {
    throw InputError(fmt::format(
        "the camera moves: its poses say {:.0f} mm and {:.2f} degrees between frames {} and {}; "
        "take "
        "fewer frames, or, if the poses are wrong, --set pose.source=fixed",
        1000.0 * motion.translation().norm(), turn_deg, number(first->index),
        number(frame->index)));
  }
}

struct Looks {
  std::vector<CalibrationLook> looks;
  FramePtr last;
};

/// Looks at good frames until there are enough, or no more.
Looks look(FrameSource& source, CalibrateCommand const& command, int most_failures,
           std::stop_token const& stop) {
  Looks seen;
  FramePtr first;
  int failures = 0;
  while (static_cast<int>(seen.looks.size()) < command.frames && !stop.stop_requested()) {
    SourceResult const result = source.next();
    if (std::holds_alternative<EndOfSource>(result)) {
      break;
    }
    if (auto const* failure = std::get_if<FrameFailure>(&result)) {
      if (failure->loss == Loss::kSilence || ++failures >= most_failures) {
        throw InputError(fmt::format("--source {}: {}", command.source, failure->message));
      }
      continue;
    }
    failures = 0;
    seen.last = std::get<FramePtr>(result);
    first = first == nullptr ? seen.last : first;
    check_still(first, seen.last);
    seen.looks.push_back(look_for_floor(seen.last->cloud_camera));
    show_progress(static_cast<int>(seen.looks.size()), command.frames);
  }
  return seen;
}

std::string fault_text(CalibrationResult const& result, int frames) {
  switch (result.fault) {
    case CalibrationFault::kNoFloor:
      return fmt::format(
          "the floor is in view in {} of {} frames, and half of them are needed: turn the camera "
          "down, or clear the floor before it",
          result.frames_with_floor, frames);
    case CalibrationFault::kFloorMoves:
      return fmt::format(
          "only {} of {} frames show the floor in one place, and half of them are needed: the "
          "camera must stand still",
          result.frames_agreeing, frames);
    case CalibrationFault::kNoWall:
      break;
  }
  return "no wall in view, upright and with nothing behind it: turn the camera towards one, or go "
         "without --wall";
}

void write_text(fs::path const& path, std::string const& text) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) {
    throw InputError("--out " + path.string() + ": cannot be written");
  }
}

void write_results(CalibrateCommand const& command, Calibration const& calibration,
                   CalibrationOrigin const& origin, Frame const& last) {
  write_text(command.out, calibration_yaml(calibration, origin));
  if (!command.picture.empty()) {
    write_png_rgb(command.picture,
                  draw_calibration(last, surfaces_in(last.cloud_camera, calibration),
                                   given_camera(given_pose(calibration.camera))));
  }
  for (std::string const& warning : calibration_warnings(calibration, origin)) {
    std::cerr << "warning: " << warning << '\n';
  }
  std::cout << calibration_table(calibration, origin)
            << fmt::format("{}: for credo run --config\n", command.out.string());
}

int run_calibration(CalibrateCommand const& command) {
  check_new_file("--out", command.out);
  if (!command.picture.empty()) {
    check_new_file("--picture", command.picture);
  }
  StopOnSignal const signals;
  PipelineConfig const config = resolved_config(command.config);
  auto const note = [](std::string const& text) { std::cerr << "warning: " << text << '\n'; };
  OpenedSource const opened = open_source(command.source, config.capture, config.pose,
                                          config.sensor, config.sim, note, signals.token());
  for (std::string const& warning : opened.warnings) {
    note(warning);
  }
  Looks seen =
      look(*opened.source, command, config.graph.max_consecutive_failures, signals.token());
  if (signals.token().stop_requested()) {
    std::cerr << "stopped before the last frame: nothing was written\n";
    return 1;
  }
  CalibrationOrigin const origin{command.source, static_cast<int>(seen.looks.size())};
  CalibrationResult const result = calibrate(std::move(seen.looks), command.wall);
  if (!result.calibration) {
    throw InputError(
        fmt::format("--source {}: {}", command.source,
                    origin.frames == 0 ? "not one good frame" : fault_text(result, origin.frames)));
  }
  write_results(command, *result.calibration, origin, *seen.last);
  return 0;
}

}  // namespace

void add_calibrate_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<CalibrateCommand>();
  CLI::App* sub = app.add_subcommand(
      "calibrate", "Find where a camera that stands still stands, by its floor and a wall");
  sub->footer(kExamples);
  sub->add_option("--source", command->source,
                  "dataset:DIR, oni:FILE, openni:[URI] or sim:NAME-or-FILE")
      ->required()
      ->type_name("URI");
  add_config_arguments(*sub, command->config);
  sub->add_option("--frames", command->frames, "good frames to look at, 1 to 300; 30 if left out")
      ->check(CLI::Range(1, 300).description(""))
      ->type_name("N");
  sub->add_flag("--wall", command->wall,
                "the most prominent wall in view becomes x = 0; otherwise x, y and yaw are the "
                "camera's own");
  sub->add_option("--out", command->out, "the overlay for --config of the other commands")
      ->required()
      ->type_name("FILE");
  sub->add_option("--picture", command->picture,
                  "what was found: floor red, wall pink, the world's floor in squares of a metre")
      ->type_name("FILE");
  sub->callback([command, &chosen] { chosen = [command] { return run_calibration(*command); }; });
}

}  // namespace credo
