#include "config_arguments.hpp"

#include "config/yaml_config.hpp"

namespace credo {

void add_config_arguments(CLI::App& command, ConfigArguments& arguments) {
  command.add_option("--config", arguments.files, "YAML file over the defaults; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      .add_option("--set", arguments.overrides,
                  "one value over all files; may be repeated, as in "
                  "--set graph.threads=2")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

PipelineConfig resolved_config(ConfigArguments const& arguments) {
  PipelineConfig config;
  load_config(fields(config), arguments.files, arguments.overrides);
  return config;
}

}  // namespace credo
