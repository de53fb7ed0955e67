#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace credo {

/// What a subcommand does once its arguments are read; returns the exit code.
using Command = std::function<int()>;

// Each adds its subcommand to the command line, which sets `chosen` when it is used.
void add_run_command(CLI::App& app, Command& chosen);
void add_record_command(CLI::App& app, Command& chosen);
void add_watch_command(CLI::App& app, Command& chosen);
void add_simulate_command(CLI::App& app, Command& chosen);
void add_eval_command(CLI::App& app, Command& chosen);
void add_detect_command(CLI::App& app, Command& chosen);
void add_model_command(CLI::App& app, Command& chosen);
void add_why_command(CLI::App& app, Command& chosen);
void add_devices_command(CLI::App& app, Command& chosen);
void add_calibrate_command(CLI::App& app, Command& chosen);
void add_doctor_command(CLI::App& app, Command& chosen);
void add_config_command(CLI::App& app, Command& chosen);

}  // namespace credo
