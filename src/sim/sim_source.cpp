#include "sim/sim_source.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "core/error.hpp"
#include "sim/camera_path.hpp"
#include "sim/depth_sensor.hpp"
#include "sim/pose_error.hpp"
#include "sim/scene_time.hpp"

namespace credo {

namespace {

/// The scene with the sensor that the config names.
Scene with_sensor(Scene scene, SimConfig const& sim) {
  if (sim.sensor != SimConfig::Sensor::kOfScene) {
    scene.camera.sensor = static_cast<SensorModel>(static_cast<int>(sim.sensor) - 1);
  }
  return scene;
}

}  // namespace

SimSource::SimSource(Scene const& scene, PoseConfig const& pose, SimConfig const& sim)
    : world_(with_sensor(scene, sim)),
      has_poses_(pose.source == PoseSource::kRecorded),
      seed_(sim.seed) {
  if (pose.source == PoseSource::kFile) {
    throw InputError("scene " + scene.name +
                     ": a simulated camera has its own poses; pose.source must not be file");
  }
  auto const& path = scene.camera.path;
  double const duration_s = path.back().time_s - path.front().time_s;
  frame_count_ =
      1 + static_cast<std::size_t>(std::floor(duration_s * scene.camera.frames_per_s + 1e-9));
}

SourceResult SimSource::next() {
  if (position_ == frame_count_) {
    return EndOfSource{};
  }
  FrameIndex const index{static_cast<std::int64_t>(position_++)};
  Scene const& scene = world_.scene();
  SceneCamera const& camera = scene.camera;
  double const time_s = scene_time_s(scene, index);
  Se3 const T_world_camera = camera_pose(camera.path, time_s);
  RenderedView view = world_.at(time_s).render(T_world_camera);
  auto frame = std::make_shared<Frame>();
  frame->index = index;
  double const since_s = time_s - scene_time_s(scene, FrameIndex{0});
  frame->stamp_ns = static_cast<std::int64_t>(std::llround(since_s * 1e9));
  frame->intrinsics = {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
  frame->cloud_camera =
      cloud_from_depth(measured_depth(view, scene, camera.sensor, seed_, index), frame->intrinsics);
  frame->color = std::move(view.color);
  frame->color_registered = true;
  frame->T_source_camera =
      has_poses_ ? told_pose(camera, T_world_camera, since_s, seed_, index) : Se3{};
  return FramePtr(std::move(frame));
}

}  // namespace credo
