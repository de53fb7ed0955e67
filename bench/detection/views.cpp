#include "views.hpp"

#include <memory>
#include <utility>

#include "core/error.hpp"
#include "io/bop_models.hpp"
#include "io/image.hpp"
#include "sim/camera_path.hpp"
#include "sim/depth_sensor.hpp"
#include "sim/household.hpp"
#include "sim/ray_caster.hpp"
#include "sim/thing.hpp"
#include "sim/visibility.hpp"

namespace credo {

std::vector<ObjectModel> all_models(std::filesystem::path const& recordings) {
  std::vector<ObjectModel> models = household_models();
  for (ObjectModel& model : read_bop_models(recordings / "objects" / "lmo", "lmo")) {
    models.push_back(std::move(model));
  }
  return models;
}

std::filesystem::path frozen_file(TabletopSet const& set) {
  return std::filesystem::path(CREDO_DETECTION_SETS_DIR) / (std::string(set.name) + ".txt");
}

std::vector<TabletopScene> frozen_scenes(TabletopSet const& set) {
  std::filesystem::path const file = frozen_file(set);
  if (!std::filesystem::exists(file)) {
    throw InputError(file.string() + ": not there; --freeze makes it");
  }
  std::vector<unsigned char> const bytes = read_bytes(file);
  return scenes_in({bytes.begin(), bytes.end()}, file.string());
}

TableView view_of(TabletopScene const& tabletop, ObjectModels const& models, int number) {
  Scene const scene = scene_of(tabletop, models);
  RayCaster const world(scene);
  Se3 const T_world_camera = camera_pose(scene.camera.path, 0.0);
  RenderedView rendered = world.render(T_world_camera);
  auto frame = std::make_shared<Frame>();
  frame->index = FrameIndex{number};
  frame->intrinsics = {scene.camera.fx_px, scene.camera.fy_px, scene.camera.cx_px,
                       scene.camera.cy_px};
  frame->cloud_camera = cloud_from_depth(
      measured_depth(rendered, scene, scene.camera.sensor, tabletop.seed, FrameIndex{0}),
      frame->intrinsics);
  frame->color = std::move(rendered.color);
  frame->color_registered = true;
  TableView view{tabletop.name, std::move(frame), {}};
  for (std::size_t i = 0; i < scene.things.size(); ++i) {
    SceneThing const& thing = scene.things[i];
    if (thing.kind == SceneKind::kObject) {
      view.truths.push_back({thing.model, T_world_camera.inverse() * pose_of(thing),
                             visible_fraction(world, i, T_world_camera)});
    }
  }
  return view;
}

std::vector<DetectionRequest> requests_for(std::vector<ObjectModel> const& models) {
  constexpr double kMetres = 3.0;
  constexpr double kAnyTurn_rad = 3.0;
  PoseDistribution anywhere{Se3(Eigen::Quaterniond::Identity(), {0, 0, 1}), Matrix6d::Zero()};
  anywhere.covariance.diagonal() << Eigen::Vector3d::Constant(kMetres * kMetres),
      Eigen::Vector3d::Constant(kAnyTurn_rad * kAnyTurn_rad);
  std::vector<DetectionRequest> requests;
  for (ObjectModel const& model : models) {
    requests.push_back({model.name, model.name, anywhere});
  }
  return requests;
}

}  // namespace credo
