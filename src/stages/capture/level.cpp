#include "stages/capture/level.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "stages/capture/floor_search.hpp"

namespace credo {
namespace {

/// The least rotation that takes `up` to +z.
Eigen::Quaterniond rotation_to_z(Eigen::Vector3d const& up) {
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
}

WorldLevel level_by_floor(Plane const& floor_source, FrameIndex frame, double height_m) {
  WorldLevel level;
  // The plane normal . p = offset becomes z = offset once the normal is turned to +z.
  level.T_world_source = Se3(rotation_to_z(floor_source.normal), {0, 0, -floor_source.offset_m});
  level.floor_found = true;
  char text[120];
  std::snprintf(text, sizeof text, "levelled by the floor in frame %lld, %.2f m below the camera",
                static_cast<long long>(number(frame)), height_m);
  level.note = text;
  return level;
}

WorldLevel level_by_config(Frame const& first, PoseConfig const& config) {
  // In the camera frame y points down; pitching down by a turns up from -y towards -z, rolling to
  // the right turns it towards -x.
  double const pitch = config.camera_pitch_rad;
  double const roll = config.camera_roll_rad;
  Eigen::Vector3d const up_camera(-std::sin(roll) * std::cos(pitch),
                                  -std::cos(roll) * std::cos(pitch), -std::sin(pitch));
  Eigen::Quaterniond const turn = rotation_to_z(first.T_source_camera.rotation() * up_camera);
  double const camera_z = (turn * first.T_source_camera.translation()).z();
  WorldLevel level;
  level.T_world_source = Se3(turn, {0, 0, config.camera_height_m - camera_z});
  char text[220];
  std::snprintf(text, sizeof text,
                "no floor in view: taking the first camera as %.2f m up, pitch %.2f rad, roll %.2f "
                "rad (pose.camera_*); nothing will be called floor",
                config.camera_height_m, pitch, roll);
  level.note = text;
  return level;
}

}  // namespace

WorldLevel find_level(std::span<FramePtr const> frames, PoseConfig const& config) {
  if (config.level == LevelMode::kOff) {
    return {Se3{}, true, "source taken as level (pose.level: off)"};
  }
  for (FramePtr const& frame : frames) {
    if (std::optional<Plane> const floor = find_floor(frame->cloud_camera, frame->intrinsics)) {
      return level_by_floor(transformed(frame->T_source_camera, *floor), frame->index,
                            floor->signed_distance_m(Eigen::Vector3d::Zero()));
    }
  }
  return level_by_config(frames.empty() ? Frame{} : *frames.front(), config);
}

}  // namespace credo
