#include <iostream>
#include <memory>

#include "commands.hpp"
#include "config/yaml_config.hpp"
#include "config_arguments.hpp"

namespace credo {
namespace {

constexpr char const* kExamples = R"(Examples:
  credo config                                     every key, its default, unit and range
  credo config --config kitchen.yaml --set graph.threads=1 > resolved.yaml
  credo config --markdown                          the defaults as a page to read)";

constexpr char const* kPageHead = R"(# Configuration

Printed by `credo config --markdown`, like [config/default.yaml](../config/default.yaml) by
`credo config`; `make docs` writes both, and a test holds them to it. Any file over the defaults goes
to `--config FILE` (later ones win), a single value to `--set key=value`. Distances are metres, angles
radians; [a, b] includes its ends.
)";

struct ConfigCommand {
  ConfigArguments config;
  bool markdown = false;
};

int print_config(ConfigCommand const& command) {
  PipelineConfig config = resolved_config(command.config);
  FieldList const list = fields(config);
  std::cout << (command.markdown ? kPageHead + config_markdown(list) : config_yaml(list));
  return 0;
}

}  // namespace

void add_config_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<ConfigCommand>();
  CLI::App* sub = app.add_subcommand("config", "Print the resolved configuration as YAML");
  sub->footer(kExamples);
  add_config_arguments(*sub, command->config);
  // The page speaks of defaults, so nothing may lie over them.
  sub->add_flag("--markdown", command->markdown, "print the defaults as a Markdown page instead")
      ->excludes("--config")
      ->excludes("--set");
  sub->callback([command, &chosen] { chosen = [command] { return print_config(*command); }; });
}

}  // namespace credo
