#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/se3.hpp"
#include "sim/depth_sensor.hpp"
#include "sim/scene.hpp"
#include "sim/scene_caster.hpp"
#include "stages/capture/calibration.hpp"

namespace credo::test {

/// Where a test puts a camera, and how it turns it, step by step: level with its view along +y, to
/// the left by `heading`, down by `pitch`, and last to its right by `roll`.
struct TruePose {
  double pitch_rad = 0.4;
  double roll_rad = 0.0;
  double height_m = 1.2;
  double heading_rad = 0.0;

  [[nodiscard]] Se3 T_world_camera() const {
    Eigen::Matrix3d level;
    level << Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY();
    return {Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) * Eigen::Quaterniond(level) *
                Eigen::AngleAxisd(-pitch_rad, Eigen::Vector3d::UnitX()) *
                Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()),
            {0.0, 0.0, height_m}};
  }
};

inline SceneThing block(std::string name, std::vector<double> size_m,
                        std::vector<double> position_m) {
  SceneThing thing;
  thing.name = std::move(name);
  thing.size_m = std::move(size_m);
  thing.position_m = std::move(position_m);
  return thing;
}

/// The distance of a room's wall across +y.
inline constexpr double kWallY_m = 2.8;

inline SceneThing floor_thing() {
  return block("floor", {12, 12, 0.1}, {0, 0, -0.1});
}
inline SceneThing wall_thing() {
  return block("wall", {6, 0.1, 2.5}, {0, kWallY_m + 0.05, 0});
}

inline Scene scene_of(std::vector<SceneThing> things) {
  Scene scene;
  scene.name = "calibration";
  scene.things = std::move(things);
  scene.camera.path = {{0.0, {0, 0, 1}, {0, 1, 1}}};
  return scene;
}

/// A floor, a wall across +y, a smaller one to the right, and things that stand on and before them.
inline Scene furnished_room() {
  return scene_of({floor_thing(), wall_thing(), block("side", {0.1, 2.5, 2.5}, {2.6, 1.55, 0}),
                   block("cabinet", {0.8, 0.4, 1.1}, {-0.9, 2.6, 0}),
                   block("parcel", {0.3, 0.3, 0.25}, {0.4, 1.7, 0})});
}

/// What a camera sees of a scene at each of those places, a frame each.
inline std::vector<CalibrationLook> looks_at(Scene const& scene, std::vector<TruePose> const& poses,
                                             SensorModel sensor) {
  SceneCaster caster(scene);
  CameraIntrinsics const intrinsics{scene.camera.fx_px, scene.camera.fy_px, scene.camera.cx_px,
                                    scene.camera.cy_px};
  std::vector<CalibrationLook> looks;
  for (TruePose const& pose : poses) {
    FrameIndex const index{static_cast<std::int64_t>(looks.size())};
    RenderedView const view = caster.at(0.0).render(pose.T_world_camera());
    looks.push_back(look_for_floor(
        cloud_from_depth(measured_depth(view, scene, sensor, 1, index), intrinsics)));
  }
  return looks;
}

}  // namespace credo::test
