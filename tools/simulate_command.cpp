#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "commands.hpp"
#include "config_arguments.hpp"
#include "io/dataset_writer.hpp"
#include "io/truth_json.hpp"
#include "model_files.hpp"
#include "scene_file.hpp"
#include "sim/scene_caster.hpp"
#include "sim/scene_time.hpp"
#include "sim/sim_source.hpp"
#include "sim/thing.hpp"
#include "sim/truth.hpp"
#include "stop_on_signal.hpp"

namespace credo {
namespace {

constexpr char const* kExamples = R"(Examples:
  credo simulate thesis-4.4.2 --out data/glass-wall
  credo simulate my-room.yaml --out data/room --set sim.sensor=disparity --set sim.seed=7
  credo run --source dataset:data/room --out out/room

DIR receives a TUM RGB-D dataset (depth/, rgb/, depth.txt, rgb.txt, groundtruth.txt,
camera-intrinsics.txt; depth to 0.2 mm), and what is true: truth.jsonl, a line a frame,
truth/NNNNNN.png, the labels of its pixels, and models/ of its objects. A scene is a name from scenes/ or a file like those; how
to write one: docs/scenes.md.)";

struct SimulateCommand {
  std::string scene;
  std::filesystem::path out;
  ConfigArguments config;
  std::optional<std::int64_t> frames;
};

void show_progress(std::int64_t done, std::int64_t all) {
  if (isatty(STDERR_FILENO) != 0) {
    std::cerr << fmt::format("\rframe {}/{}{}", done, all, done == all ? "\n" : "") << std::flush;
  }
}

/// The models of the scene's objects, so that whoever scores needs nothing but the folder.
void copy_models(Scene const& scene, std::filesystem::path const& folder) {
  std::filesystem::path const file = find_scene(scene.name);
  for (SceneThing const& thing : scene.things) {
    if (thing.kind != SceneKind::kObject) {
      continue;
    }
    std::filesystem::path const model = thing.model.empty()
                                            ? model_called(type_of(thing), file.parent_path())
                                            : find_model(thing.model, file, file.string());
    if (!model.empty()) {
      copy_model(model, folder / "models", type_of(thing));
    }
  }
}

int simulate(SimulateCommand const& command) {
  StopOnSignal const signals;
  PipelineConfig const config = resolved_config(command.config);
  Scene const scene = load_scene(command.scene);
  SimSource source(scene, config.pose, config.sim);
  auto const all = static_cast<std::int64_t>(source.frame_count());
  std::int64_t const frames = std::min(all, command.frames.value_or(all));
  DatasetWriter writer(command.out);
  copy_models(scene, command.out);
  SceneCaster world(scene);  // a frame does not tell what it shows: rendered anew
  std::int64_t done = 0;
  while (done < frames && !signals.token().stop_requested()) {
    auto const frame = std::get<FramePtr>(source.next());
    FrameTruth const truth = truth_of(world, frame->index);
    writer.write(*frame);
    RenderedView const view =
        world.at(scene_time_s(scene, frame->index)).render(truth.T_world_camera);
    writer.write_truth(frame->index, truth_json(truth),
                       true_labels(scene, view, frame->cloud_camera.z));
    show_progress(++done, frames);
  }
  std::cout << fmt::format("{} frames of {} in {}\n", done, scene.name, command.out.string());
  return 0;
}

}  // namespace

void add_simulate_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<SimulateCommand>();
  CLI::App* sub = app.add_subcommand("simulate", "Write a simulated scene as a dataset with truth");
  sub->footer(kExamples);
  sub->add_option("scene", command->scene, "name or file")->required()->type_name("SCENE");
  sub->add_option("--out", command->out, "folder for the dataset; made if need be")
      ->required()
      ->type_name("DIR");
  add_config_arguments(*sub, command->config);
  sub->add_option("--frames", command->frames, "stop after so many frames, 1 or more")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  sub->callback([command, &chosen] { chosen = [command] { return simulate(*command); }; });
}

}  // namespace credo
