#include <unistd.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "belief_table.hpp"
#include "commands.hpp"
#include "config_arguments.hpp"
#include "dds/belief_subscriber.hpp"
#include "io/belief_json.hpp"
#include "stop_on_signal.hpp"

namespace credo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char const* kExamples = R"(Examples:
  credo watch                              a table that redraws with every belief
  credo watch --json > beliefs.jsonl       a line each, as in belief.jsonl
  credo watch --json --once --timeout 5    the last belief of a run that goes on or lingers
  credo watch --set dds.source=robot-2     of one of several

Listens on dds.interface (lo: this machine) in dds.domain. Exit codes: 0 done (also when stopped by
Ctrl-C), 1 no belief within --timeout, 2 bad usage or config.)";

/// How long a signal may wait.
constexpr auto kTick = std::chrono::milliseconds(100);

struct WatchCommand {
  ConfigArguments config;
  bool json = false;
  bool once = false;
  std::optional<double> timeout_s;
};

/// On a terminal over the last one, else below it.
void show(ReceivedBelief const& received, bool json) {
  bool const redraw = !json && isatty(STDOUT_FILENO) != 0;
  std::cout << (redraw ? "\033[H\033[J" : "")
            << (json ? belief_json(received.belief) + "\n"
                     : belief_table(received.source, received.belief))
            << std::flush;
}

int watch(WatchCommand const& command) {
  StopOnSignal const signals;
  PipelineConfig const config = resolved_config(command.config);
  BeliefSubscriber subscriber(config.dds);
  auto last = Clock::now();
  while (!signals.token().stop_requested()) {
    for (ReceivedBelief const& received : subscriber.take(kTick)) {
      if (!config.dds.source.empty() && received.source != config.dds.source) {
        continue;
      }
      if (received.gone) {
        std::cerr << "credo: " << received.source << " has left\n";
        continue;
      }
      show(received, command.json);
      last = Clock::now();
      if (command.once || !std::cout) {
        return 0;
      }
    }
    if (command.timeout_s &&
        Clock::now() - last > std::chrono::duration<double>(*command.timeout_s)) {
      std::cerr << "credo: no belief on DDS topic " << config.dds.topic_prefix << "/belief, domain "
                << config.dds.domain << ", interface " << config.dds.interface_name << ", for "
                << *command.timeout_s << " s\n";
      return 1;
    }
  }
  return 0;
}

}  // namespace

void add_watch_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<WatchCommand>();
  CLI::App* sub = app.add_subcommand("watch", "Show the belief of a Credo that runs elsewhere");
  sub->footer(kExamples);
  add_config_arguments(*sub, command->config);
  sub->add_flag("--json", command->json, "lines as in belief.jsonl instead of a table");
  sub->add_flag("--once", command->once, "end after the first belief");
  sub->add_option("--timeout", command->timeout_s,
                  "end when no belief has come for so long, seconds")
      ->check(CLI::PositiveNumber)
      ->type_name("S");
  sub->callback([command, &chosen] { chosen = [command] { return watch(*command); }; });
}

}  // namespace credo
