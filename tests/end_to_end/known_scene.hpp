#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/belief.hpp"
#include "core/detector_config.hpp"
#include "core/object_model.hpp"
#include "graph/pipeline_config.hpp"
#include "graph/stages.hpp"
#include "sim/scene.hpp"

namespace credo::test {

/// scenes/NAME.yaml.
Scene project_scene(std::string const& name);
/// models/NAME.yaml.
ObjectModel project_model(std::string const& name);

/// A scene, and what the robot was told of it.
struct KnownScene {
  Scene scene;
  BeliefState prior;
  ObjectModels models;
};
/// scenes/NAME.yaml with scenes/priors/NAME.yaml.
KnownScene known_scene(std::string const& name);

/// What make_stages needs of it, with a detector that knows the truth.
std::shared_ptr<KnownObjects const> known_objects(KnownScene const& known,
                                                  SimDetectorConfig const& detector);

/// The beliefs after each of the scene's frames, one after the other (run_once).
std::vector<BeliefPtr> run_scene(KnownScene const& known, SimDetectorConfig const& detector,
                                 PipelineConfig const& config = {});

/// The same view in fewer pixels, 1 / factor each way.
SceneCamera smaller(SceneCamera camera, int factor);
/// A detector without an error.
SimDetectorConfig exact_detector();

/// Where a thing of the scene truly is in a frame.
Se3 true_pose(Scene const& scene, std::int64_t frame, std::string const& name);
/// Which thing each pixel of a frame truly shows: its position in Scene::things, -1 for none.
Grid<std::int32_t> true_things(Scene const& scene, std::int64_t frame);
std::int32_t position_of(Scene const& scene, std::string const& name);

}  // namespace credo::test
