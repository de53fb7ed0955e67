#include <malloc.h>

#include <exception>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "commands.hpp"
#include "core/error.hpp"

namespace {

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

constexpr char const* kExamples = R"(Examples:
  credo run --source dataset:recordings/kitchen --out out/kitchen --dump labels,pictures
  credo run --source dataset:recordings/kitchen --frames 40 --set graph.threads=1
  credo record --source openni: --out data/desk
  credo watch --json --once --timeout 5
  credo simulate first-light --out data/room --set sim.sensor=disparity
  credo eval out/room --truth data/room
  credo detect --source dataset:recordings/desk --model cat.yaml --picture found.png
  credo model milk.pcd --out milk.ply
  credo why out/room stuff:7
  credo config --set fusion.prior_probability=0.9 > my.yaml
  credo run --source sim:first-light --config my.yaml --out out/room

Exit codes: 0 done (also when stopped by Ctrl-C), 2 bad usage, config or input, 1 anything else.
`credo COMMAND --help` tells more.)";

/// Every line of an error stands for itself.
void print_error(std::string const& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::cerr << "credo: " << line << '\n';
  }
}

int run_command_line(int argc, char** argv) {
  CLI::App app("Credo: what a robot believes is around it, from an RGB-D camera, in real time",
               "credo");
  app.set_version_flag("--version", "credo " CREDO_VERSION);
  app.footer(kExamples);
  app.require_subcommand(1);
  credo::Command chosen;
  credo::add_run_command(app, chosen);
  credo::add_record_command(app, chosen);
  credo::add_watch_command(app, chosen);
  credo::add_simulate_command(app, chosen);
  credo::add_eval_command(app, chosen);
  credo::add_detect_command(app, chosen);
  credo::add_model_command(app, chosen);
  credo::add_why_command(app, chosen);
  credo::add_devices_command(app, chosen);
  credo::add_calibrate_command(app, chosen);
  credo::add_doctor_command(app, chosen);
  credo::add_config_command(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (CLI::Success const& help) {
    return app.exit(help);
  } catch (CLI::ParseError const& error) {
    // What was not understood says more than what is missing because of it.
    std::vector<std::string> const unknown = app.remaining(true);
    print_error((unknown.empty() ? error.what() : unknown.front() + ": no such command or option") +
                "; see credo --help");
    return kBadInput;
  }
  int const code = chosen();
  // A full disk behind a redirection shows only here.
  if (!std::cout.flush()) {
    throw credo::InputError("standard output cannot be written: is the disk full?");
  }
  return code;
}

/// Frames come and go in the same sizes: what is given back to the kernel after each one must be
/// faulted in again for the next, page by page.
void keep_freed_memory() {
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  try {
    return run_command_line(argc, argv);
  } catch (credo::InputError const& error) {
    print_error(error.what());
    return kBadInput;
  } catch (std::exception const& error) {
    print_error(std::string("unexpected: ") + error.what());
    return kFailed;
  }
}
