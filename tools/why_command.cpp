#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "config/yaml_config.hpp"
#include "core/error.hpp"
#include "graph/pipeline_config.hpp"
#include "history/history.hpp"
#include "history/history_names.hpp"
#include "history/history_plot.hpp"
#include "history_text.hpp"
#include "io/image.hpp"
#include "run_beliefs.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr char const* kExamples = R"(Examples:
  credo why out/room                         all that was ever believed, what moved most first
  credo why out/room stuff:7                 or just 7
  credo why out/room wall:2                  or floor, or a known object's id
  credo why out/room 7 --plot why-7.svg      the same drawn over the time
  credo why out/room 7 --json                for scripts

One row for each span of frames with the same evidence. Points are those of the thing's surface:
agree (measured where they should be), hidden (something nearer), through (seen through), blind (no
depth), out (of view). News is how many independent looks the frames are worth; log-odds are natural
logarithms of p / (1 - p). docs/why.md has an example.)";

struct WhyCommand {
  fs::path run;
  std::string id;
  fs::path plot;
  bool json = false;
};

std::vector<ThingHistory> histories_of_run(fs::path const& run) {
  std::vector<BeliefSummary> const beliefs = beliefs_of_run(run);
  auto const untold =
      std::ranges::find_if_not(beliefs, [](BeliefSummary const& b) { return tells_why(b); });
  if (untold != beliefs.end()) {
    throw InputError(fmt::format(
        "{}: frame {} does not tell why: it was written by an older version of credo, or is no "
        "run's; run it again",
        (run / "belief.jsonl").string(), number(untold->frame)));
  }
  return histories_of(beliefs);
}

ThingHistory const& thing_of(std::vector<ThingHistory> const& histories,
                             WhyCommand const& command) {
  if (ThingHistory const* found = find_thing(histories, command.id)) {
    return *found;
  }
  constexpr std::size_t kNear = 5;
  std::string near;
  for (std::string const& name : near_names(histories, command.id, kNear)) {
    near += (near.empty() ? "" : ", ") + name;
  }
  throw InputError(near.empty()
                       ? fmt::format("{}: the run never believed anything", command.run.string())
                       : fmt::format("{}: the run has no {}; near that: {}; all {}: credo why {}",
                                     command.run.string(), command.id, near, histories.size(),
                                     command.run.string()));
}

/// None where the config is not there, or not of this version.
BeliefLimits limits_of_run(fs::path const& run) {
  try {
    PipelineConfig config;
    load_config(fields(config), {run / "config.yaml"}, {});
    BeliefLimits limits;
    if (config.fusion.existence.max_log_odds > 0.0) {
      limits.max_log_odds = config.fusion.existence.max_log_odds;
    }
    limits.min_probability = config.fusion.existence.min_probability;
    return limits;
  } catch (InputError const&) {
    return {};
  }
}

int why(WhyCommand const& command) {
  std::vector<ThingHistory> histories = histories_of_run(command.run);
  if (command.id.empty()) {
    std::ranges::stable_sort(histories, std::ranges::greater(), travelled);
    std::cout << (command.json ? histories_json(histories) : histories_table(histories));
    return 0;
  }
  ThingHistory const& thing = thing_of(histories, command);
  if (!command.plot.empty()) {
    std::string const svg = history_plot(thing, limits_of_run(command.run));
    write_bytes(command.plot, EncodedPng(svg.begin(), svg.end()));
  }
  bool const in_color = isatty(STDOUT_FILENO) != 0;
  std::cout << (command.json ? history_json(thing) : history_text(thing, in_color));
  return 0;
}

}  // namespace

void add_why_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<WhyCommand>();
  CLI::App* sub = app.add_subcommand("why", "Tell why the probability of a thing moved");
  sub->footer(kExamples);
  sub->add_option("run", command->run, "folder that credo run --out wrote")
      ->required()
      ->type_name("RUN");
  CLI::Option* id =
      sub->add_option("id", command->id,
                      "a known object's id, stuff:7 or 7, wall:2, floor; without it, all")
          ->type_name("ID");
  sub->add_option("--plot", command->plot, "draw its probability over the time, as SVG")
      ->needs(id)
      ->type_name("FILE.svg");
  sub->add_flag("--json", command->json, "print it as JSON");
  sub->callback([command, &chosen] { chosen = [command] { return why(*command); }; });
}

}  // namespace credo
