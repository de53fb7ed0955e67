#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "graph/pipeline_config.hpp"

namespace credo {

/// `--config FILE` and `--set K=V`, as every subcommand that has a config takes them.
struct ConfigArguments {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> overrides;
};

void add_config_arguments(CLI::App& command, ConfigArguments& arguments);

/// The defaults, then the files, then the overrides. Throws InputError with every fault there is.
PipelineConfig resolved_config(ConfigArguments const& arguments);

}  // namespace credo
