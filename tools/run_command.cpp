#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "commands.hpp"
#include "config/yaml_config.hpp"
#include "config_arguments.hpp"
#include "core/error.hpp"
#include "dds/belief_publisher.hpp"
#include "geometry/shapes/outline.hpp"
#include "graph/pipeline.hpp"
#include "graph/read_ahead.hpp"
#include "known_objects.hpp"
#include "progress.hpp"
#include "run_output.hpp"
#include "source_uri.hpp"
#include "status_line.hpp"
#include "stop_on_signal.hpp"

namespace credo {
namespace {

constexpr char const* kExamples = R"(Examples:
  credo run --source dataset:recordings/kitchen --out out/kitchen --dump labels,pictures
  credo run --source dataset:recordings/kitchen --frames 40 --set graph.threads=1
  credo run --source sim:box-on-table --prior scenes/priors/box-on-table.yaml \
      --set detector.kind=sim --out out/box --dump pictures
  credo run --source oni:recordings/living-room.oni --out out/living-room --dump pictures
  credo run --source openni: --out out/live        (the first sensor that OpenNI2 finds; Ctrl-C ends)
  credo run --source dataset:clouds --set capture.independent_frames=true --out out/clouds

Into --out go belief.jsonl (one line a good frame), metrics.json, config.yaml (resolved), and with
--dump labels/NNNNNN.png and pictures/NNNNNN.png. Ctrl-C finishes the frames under way and writes
everything; a second one does not wait.)";

struct RunCommand {
  std::string source;
  ConfigArguments config;
  std::optional<std::filesystem::path> prior;
  std::optional<std::int64_t> frames;
  std::optional<std::filesystem::path> out;
  std::vector<std::string> dump;
  bool no_dds = false;
  double linger_s = 0.0;
};

CLI::Validator at_least(double least) {
  return {[least](std::string const& text) {
            char* end = nullptr;
            double const value = std::strtod(text.c_str(), &end);
            return *end == '\0' && value >= least
                       ? std::string()
                       : text + ": must be " + fmt::format("{}", least) + " or more";
          },
          ""};
}

Dump dump_of(RunCommand const& command) {
  auto const wants = [&](char const* what) {
    return std::find(command.dump.begin(), command.dump.end(), what) != command.dump.end();
  };
  return {wants("labels"), wants("pictures")};
}

void check_usage(RunCommand const& command) {
  if (!command.dump.empty() && !command.out.has_value()) {
    throw InputError("--dump has nowhere to write: add --out DIR");
  }
}

WorldLevel level_of(ReadAhead& source, PipelineConfig const& config, Workers& workers) {
  if (config.capture.independent_frames) {
    return {Se3{}, true, "each frame is a scene of its own, levelled by itself"};
  }
  return workers.execute([&] { return find_level_ahead(source, config.pose); });
}

void log_start(std::vector<std::string> const& warnings, WorldLevel const& level) {
  for (std::string const& warning : warnings) {
    spdlog::warn(warning);
  }
  spdlog::log(level.floor_found ? spdlog::level::info : spdlog::level::warn, level.note);
}

LoadedPrior prior_of(RunCommand const& command, PipelineConfig const& config) {
  LoadedPrior loaded;
  if (command.prior.has_value()) {
    loaded = load_prior(*command.prior, config.fusion.prior_probability);
  }
  if (!loaded.prior.objects.empty() && config.detector.kind == DetectorKind::kNone) {
    loaded.warnings.emplace_back(
        "nobody looks for the prior's objects, so nothing is learnt of them: set detector.kind");
  }
  if (loaded.prior.objects.empty() && config.detector.kind != DetectorKind::kNone) {
    loaded.warnings.emplace_back(
        "the detector has nothing to look for: tell which objects are there with --prior");
  }
  return loaded;
}

std::shared_ptr<KnownObjects const> known_objects(ObjectModels models, PipelineConfig const& config,
                                                  std::string const& source_uri) {
  auto known = std::make_shared<KnownObjects>();
  known->models = std::move(models);
  known->shapes = shapes_of(known->models);
  known->surfaces = known_surfaces(known->models);
  known->detector = open_detector(config.detector, config.dds, source_uri, known->models,
                                  [](std::string const& note) { spdlog::warn(note); });
  return known;
}

/// That a run will read; none where the source does not know its end.
std::optional<std::int64_t> frame_count(OpenedSource const& opened,
                                        std::optional<std::int64_t> most) {
  if (!opened.frame_count) {
    return most;
  }
  auto const all = static_cast<std::int64_t>(*opened.frame_count);
  return std::min(all, most.value_or(all));
}

/// A prior given in the camera's frame needs to know where that camera is.
BeliefPtr first_belief(ReadAhead& source, WorldLevel const& level, Prior const& prior) {
  FramePtr const first = prior.frame == PriorFrame::kCamera ? source.first_frame() : nullptr;
  Se3 const T_world_camera =
      first != nullptr ? level.T_world_source * first->T_source_camera : Se3();
  return std::make_shared<BeliefState const>(prior_belief(prior, T_world_camera));
}

std::unique_ptr<BeliefPublisher> publisher_of(RunCommand const& command, DdsConfig const& config) {
  if (command.no_dds) {
    return nullptr;
  }
  try {
    auto publisher = std::make_unique<BeliefPublisher>(config);
    publisher->tell(LifecycleState::kRunning, command.source);
    return publisher;
  } catch (InputError const& error) {
    throw InputError(std::string(error.what()) + "; --no-dds runs without");
  }
}

std::string dds_summary(BeliefPublisher const& publisher) {
  return publisher.dropped() > 0
             ? fmt::format("DDS: {} samples dropped, its buffers were full\n", publisher.dropped())
             : "";
}

/// Stays on DDS so that who comes after the last frame finds the belief.
void linger(RunCommand const& command, BeliefPublisher* publisher, std::stop_token const& stop) {
  if (publisher == nullptr) {
    return;
  }
  if (command.linger_s > 0.0 && !stop.stop_requested()) {
    publisher->tell(LifecycleState::kLingering, command.source);
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any never;
    never.wait_for(lock, stop, std::chrono::duration<double>(command.linger_s),
                   [] { return false; });
  }
  publisher->tell(LifecycleState::kStopping, command.source);
}

/// What a run reads: opened, and all that needs no frame checked.
struct Inputs {
  PipelineConfig config;
  LoadedPrior prior;
  std::shared_ptr<KnownObjects const> known;
  OpenedSource opened;
};

/// From the first frame to the last; throws what ends it early.
void play(RunCommand const& command, Inputs inputs, BeliefPublisher* publisher,
          std::stop_token const& stop) {
  PipelineConfig const& config = inputs.config;
  Prior const& prior = inputs.prior.prior;
  std::optional<std::int64_t> const frames_to_come = frame_count(inputs.opened, command.frames);
  ReadAhead source(std::move(inputs.opened.source), command.frames);
  Workers workers(config.graph.threads);
  WorldLevel const level = level_of(source, config, workers);
  BeliefPtr const prior_world = first_belief(source, level, prior);

  // Nothing is written before all that can be checked has been, and bad input is told in one line.
  Dump const dump = dump_of(command);
  std::optional<RunFolder> folder;
  if (command.out.has_value()) {
    folder.emplace(*command.out, dump.labels, dump.pictures, config_yaml(fields(inputs.config)));
  }
  log_start(inputs.prior.warnings, level);
  Outlines const outlines = outlines_of(inputs.known->models);
  Progress progress(frames_to_come);
  std::optional<LevelWatch> watch;
  if (level.floor_found && config.pose.level != LevelMode::kOff && is_live(command.source)) {
    watch.emplace(level);
  }
  RunReport const report =
      run_pipeline(source, make_stages(config, level, prior, inputs.known),
                   run_output(folder.has_value() ? &*folder : nullptr, publisher, dump, outlines,
                              progress, command.source, watch.has_value() ? &*watch : nullptr),
                   config.graph, prior_world, workers, stop);
  progress.finish();
  if (folder.has_value()) {
    folder->write_metrics(report.metrics);
  }
  if (publisher != nullptr) {
    publisher->publish(report.metrics);
  }
  if (report.error != nullptr) {
    std::rethrow_exception(report.error);
  }
  std::cout << summary_table(report.metrics) << progress.detection_summary()
            << (publisher != nullptr ? dds_summary(*publisher) : "") << std::flush;
}

int run(RunCommand const& command) {
  check_usage(command);
  log_to_stderr();
  StopOnSignal const signals;
  Inputs inputs;
  inputs.config = resolved_config(command.config);
  inputs.prior = prior_of(command, inputs.config);
  inputs.known = known_objects(std::move(inputs.prior.models), inputs.config, command.source);
  inputs.opened = open_source(
      command.source, inputs.config.capture, inputs.config.pose, inputs.config.sensor,
      inputs.config.sim, [](std::string const& note) { spdlog::warn(note); }, signals.token());
  std::ranges::move(inputs.opened.warnings, std::back_inserter(inputs.prior.warnings));
  std::unique_ptr<BeliefPublisher> const publisher = publisher_of(command, inputs.config.dds);
  if (auto const warning = receive_buffer_warning(rmem_max_bytes()); warning && publisher) {
    inputs.prior.warnings.push_back(*warning);
  }
  try {
    play(command, std::move(inputs), publisher.get(), signals.token());
  } catch (std::exception const& error) {
    if (publisher != nullptr) {
      publisher->tell(LifecycleState::kStopping, error.what());
    }
    throw;
  }
  linger(command, publisher.get(), signals.token());
  return 0;
}

}  // namespace

void add_run_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<RunCommand>();
  CLI::App* sub = app.add_subcommand("run", "Turn a source of RGB-D frames into a belief");
  sub->footer(kExamples);
  sub->add_option("--source", command->source,
                  "dataset:DIR, oni:FILE, openni:[URI] or sim:NAME-or-FILE")
      ->required()
      ->type_name("URI");
  add_config_arguments(*sub, command->config);
  sub->add_option("--prior", command->prior, "known objects and roughly where they are (YAML)")
      ->type_name("FILE");
  sub->add_option("--frames", command->frames, "stop after so many frames, 1 or more")
      ->check(at_least(1))
      ->type_name("N");
  sub->add_option("--out", command->out, "folder for the results; made if need be")
      ->type_name("DIR");
  sub->add_option("--dump", command->dump, "images to write for each frame: labels, pictures")
      ->delimiter(',')
      ->check(CLI::IsMember({"labels", "pictures"}).description(""))
      ->allow_extra_args(false)
      ->type_name("WHAT,...");
  sub->add_flag("--no-dds", command->no_dds, "publish nothing");
  sub->add_option("--linger", command->linger_s,
                  "stay on DDS so long after the last frame, seconds")
      ->check(at_least(0))
      ->type_name("S");
  sub->callback([command, &chosen] { chosen = [command] { return run(*command); }; });
}

}  // namespace credo
