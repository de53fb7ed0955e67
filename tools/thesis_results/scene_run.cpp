#include "scene_run.hpp"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "../known_objects.hpp"
#include "../scene_file.hpp"
#include "config/yaml_config.hpp"
#include "geometry/shapes/outline.hpp"
#include "graph/pipeline_config.hpp"
#include "graph/read_ahead.hpp"
#include "graph/run_once.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scene_time.hpp"
#include "sim/sim_source.hpp"
#include "sim/truth.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

fs::path const kRoot = CREDO_ROOT;

std::string prior_file(Recipe const& recipe) {
  return "scenes/priors/" + recipe.prior + ".yaml";
}

std::vector<std::string> overrides_of(Recipe const& recipe) {
  std::vector<std::string> all;
  if (!recipe.prior.empty()) {
    all.emplace_back("detector.kind=sim");
  }
  all.insert(all.end(), recipe.overrides.begin(), recipe.overrides.end());
  return all;
}

PipelineConfig config_of(Recipe const& recipe) {
  PipelineConfig config;
  std::vector<fs::path> files;
  if (recipe.thesis_numbers) {
    files.push_back(kRoot / "config/thesis.yaml");
  }
  load_config(fields(config), files, overrides_of(recipe));
  return config;
}

LabelMap true_labels_of(Scene const& scene, FrameTruth const& truth, Frame const& frame) {
  RayCaster const caster(scene, scene_time_s(scene, frame.index));
  return true_labels(scene, caster.render(truth.T_world_camera), frame.cloud_camera.z);
}

}  // namespace

std::string command_of(Recipe const& recipe, std::string const& out) {
  std::vector<std::string> parts = {"build/bin/credo run", "--source sim:" + recipe.scene};
  if (recipe.thesis_numbers) {
    parts.emplace_back("--config config/thesis.yaml");
  }
  if (!recipe.prior.empty()) {
    parts.push_back("--prior " + prior_file(recipe));
  }
  for (std::string const& value : overrides_of(recipe)) {
    parts.push_back("--set " + (value.find('[') != std::string::npos ? "'" + value + "'" : value));
  }
  parts.insert(parts.end(), {"--no-dds", "--dump labels,pictures", "--out " + out});
  constexpr std::size_t kWidth = 90;
  std::string text;
  std::string line;
  for (std::string const& part : parts) {
    if (line.size() + part.size() > kWidth) {
      text += line + " \\\n";
      line = "   ";
    }
    line += (line.empty() ? "" : " ") + part;
  }
  return text + line;
}

SceneRun run_recipe(Recipe const& recipe) {
  PipelineConfig const config = config_of(recipe);
  Scene const scene = load_scene(recipe.scene);
  LoadedPrior prior;
  if (!recipe.prior.empty()) {
    prior = load_prior(kRoot / prior_file(recipe), config.fusion.prior_probability);
  }
  auto const known = std::make_shared<KnownObjects>();
  known->models = std::move(prior.models);
  known->shapes = shapes_of(known->models);
  known->surfaces = known_surfaces(known->models);
  known->detector = open_detector(config.detector, config.dds, "sim:" + recipe.scene, known->models,
                                  [](std::string const& note) { spdlog::warn(note); });
  ReadAhead source(std::make_unique<SimSource>(scene, config.pose, config.sim));
  WorldLevel const level = find_level_ahead(source, config.pose);
  auto const first = std::make_shared<BeliefState const>(prior_belief(prior.prior, Se3()));

  SceneRun run;
  run.outlines = outlines_of(known->models);
  RunSink sink;
  sink.encode = [&](FrameResult const& result) -> Delivery {
    SceneLook look{
        result.frame, result.segmentation, result.belief, truth_of(scene, result.frame->index), {}};
    look.true_labels = true_labels_of(scene, look.truth, *look.frame);
    return [&run, look = std::move(look)] { run.looks.push_back(look); };
  };
  sink.lost = [](FrameFailure const& failure) { throw std::runtime_error(failure.message); };
  RunReport const report = run_once(source, make_stages(config, level, prior.prior, known), sink,
                                    config.graph, first, {});
  if (report.error != nullptr) {
    std::rethrow_exception(report.error);
  }
  return run;
}

}  // namespace credo
