#include "end_to_end/known_scene.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "config/yaml_config.hpp"
#include "core/prior_file.hpp"
#include "graph/read_ahead.hpp"
#include "graph/run_once.hpp"
#include "graph/run_sink.hpp"
#include "sim/camera_path.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scene_time.hpp"
#include "sim/sim_detector.hpp"
#include "sim/sim_source.hpp"
#include "sim/thing.hpp"
#include "support/paths.hpp"
#include "tools/model_files.hpp"
#include "tools/scene_file.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;

fs::path project() {
  return source_folder();
}

}  // namespace

Scene project_scene(std::string const& name) {
  return load_scene(name);
}

ObjectModel project_model(std::string const& name) {
  std::vector<std::string> not_told;
  return load_model(project() / "models" / (name + ".yaml"), not_told);
}

KnownScene known_scene(std::string const& name) {
  KnownScene known{project_scene(name), {}, {}};
  fs::path const path = project() / "scenes/priors" / (name + ".yaml");
  PriorFile file;
  load_config(fields(file), {path}, {});
  known.prior = prior_belief(prior_of(file, 0.99, path.string()), Se3());
  for (ObjectBelief const& object : known.prior.objects) {
    known.models.try_emplace(object.type, project_model(object.type));
  }
  return known;
}

std::shared_ptr<KnownObjects const> known_objects(KnownScene const& known,
                                                  SimDetectorConfig const& detector) {
  auto objects = std::make_shared<KnownObjects>();
  objects->models = known.models;
  objects->shapes = shapes_of(known.models);
  objects->surfaces = known_surfaces(known.models);
  objects->detector = std::make_unique<SimDetector>(known.scene, detector);
  return objects;
}

std::vector<BeliefPtr> run_scene(KnownScene const& known, SimDetectorConfig const& detector,
                                 PipelineConfig const& config) {
  ReadAhead source(std::make_unique<SimSource>(known.scene, PoseConfig{}));
  WorldLevel const level = find_level_ahead(source, config.pose);
  std::vector<BeliefPtr> beliefs;
  RunSink const sink = {[&](FrameResult const& result) -> Delivery {
                          return [&beliefs, belief = result.belief] { beliefs.push_back(belief); };
                        },
                        [](FrameFailure const& failure) {
                          throw std::runtime_error("a frame failed: " + failure.message);
                        }};
  run_once(source, make_stages(config, level, {}, known_objects(known, detector)), sink,
           config.graph, std::make_shared<BeliefState const>(known.prior), {});
  return beliefs;
}

SceneCamera smaller(SceneCamera camera, int factor) {
  camera.width_px /= factor;
  camera.height_px /= factor;
  for (double* value : {&camera.fx_px, &camera.fy_px, &camera.cx_px, &camera.cy_px}) {
    *value /= factor;
  }
  return camera;
}

SimDetectorConfig exact_detector() {
  SimDetectorConfig detector;
  detector.sigma_position_m = 0.0;
  detector.sigma_rotation_rad = 0.0;
  return detector;
}

std::int32_t position_of(Scene const& scene, std::string const& name) {
  auto const found = std::ranges::find(scene.things, name, &SceneThing::name);
  if (found == scene.things.end()) {
    throw std::logic_error("no thing is called " + name);
  }
  return static_cast<std::int32_t>(found - scene.things.begin());
}

Se3 true_pose(Scene const& scene, std::int64_t frame, std::string const& name) {
  PresentThings const things = things_at(scene, scene_time_s(scene, FrameIndex{frame}));
  return pose_of(things.at(static_cast<std::size_t>(position_of(scene, name))).value());
}

Grid<std::int32_t> true_things(Scene const& scene, std::int64_t frame) {
  double const time_s = scene_time_s(scene, FrameIndex{frame});
  return RayCaster(scene, time_s).render(camera_pose(scene.camera.path, time_s)).thing;
}

}  // namespace credo::test
