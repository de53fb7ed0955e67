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
  credo config --markdown > docs/config.md)";

struct ConfigCommand {
  ConfigArguments config;
  bool markdown = false;
};

int print_config(ConfigCommand const& command) {
  PipelineConfig config = resolved_config(command.config);
  FieldList const list = fields(config);
  std::cout << (command.markdown ? config_markdown(list) : config_yaml(list));
  return 0;
}

}  // namespace

void add_config_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<ConfigCommand>();
  CLI::App* sub = app.add_subcommand("config", "Print the resolved configuration as YAML");
  sub->footer(kExamples);
  add_config_arguments(*sub, command->config);
  sub->add_flag("--markdown", command->markdown, "print it as a Markdown table");
  sub->callback([command, &chosen] { chosen = [command] { return print_config(*command); }; });
}

}  // namespace credo
