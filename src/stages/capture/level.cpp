#include "stages/capture/level.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "stages/capture/coarse_cloud.hpp"
#include "stages/capture/floor_lean.hpp"
#include "stages/capture/floor_search.hpp"

namespace credo {
namespace {

/// The least rotation that takes `up` to +z.
Eigen::Quaterniond rotation_to_z(Eigen::Vector3d const& up) {
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
}

std::string two_decimals(double value) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << value;
  return text.str();
}

/// The floor's height alone, of a source that is level as far as one frame can tell.
WorldLevel level_as_source(FloorLean const& lean, Frame const& frame) {
  WorldLevel level;
  double const shift_m = lean.may_be_at_zero() ? 0.0 : -lean.height_m;
  level.T_world_source = Se3(Eigen::Quaterniond::Identity(), {0, 0, shift_m});
  level.floor_found = true;
  level.note = "source taken as level: the floor in frame " + std::to_string(number(frame.index)) +
               " leans by " + two_decimals(lean.lean_rad() * 180.0 / std::numbers::pi) +
               " degrees, no more than one frame's floor may be wrong by";
  return level;
}

/// A world levelled by a frame's floor leans by as much as that floor is wrong, and objects 8 m
/// away are centimetres off in it; poses that are level already must not be made to lean so.
WorldLevel level_by_floor(Plane const& floor_camera, CoarseCloud const& coarse, Frame const& frame,
                          LevelMode mode) {
  FloorLean const lean = floor_lean(floor_camera, coarse, frame.T_source_camera);
  if (mode != LevelMode::kByFloor && lean.may_be_level()) {
    return level_as_source(lean, frame);
  }
  Plane const floor_source = transformed(frame.T_source_camera, floor_camera);
  WorldLevel level;
  // The plane normal . p = offset becomes z = offset once the normal is turned to +z.
  level.T_world_source = Se3(rotation_to_z(floor_source.normal), {0, 0, -floor_source.offset_m});
  level.floor_found = true;
  level.note = "levelled by the floor in frame " + std::to_string(number(frame.index)) + ", " +
               two_decimals(floor_camera.signed_distance_m(Eigen::Vector3d::Zero())) +
               " m below the camera";
  return level;
}

WorldLevel level_by_config(Frame const& first, PoseConfig const& config) {
  double const pitch = config.camera_pitch_rad;
  double const roll = config.camera_roll_rad;
  Eigen::Vector3d const up_camera = up_of_camera(pitch, roll);
  Eigen::Quaterniond const turn = rotation_to_z(first.T_source_camera.rotation() * up_camera);
  double const camera_z = (turn * first.T_source_camera.translation()).z();
  WorldLevel level;
  level.T_world_source = Se3(turn, {0, 0, config.camera_height_m - camera_z});
  level.note = "no floor in view: taking the first camera as " +
               two_decimals(config.camera_height_m) + " m up, pitch " + two_decimals(pitch) +
               " rad, roll " + two_decimals(roll) +
               " rad (pose.camera_*); nothing will be called floor";
  return level;
}

WorldLevel level_as_given(Frame const& first, PoseConfig const& config) {
  WorldLevel level;
  level.T_world_source = given_camera(config) * first.T_source_camera.inverse();
  level.floor_found = true;
  level.given = true;
  level.note = "the camera stands as given: " + two_decimals(config.camera_height_m) +
               " m up, pitch " + two_decimals(config.camera_pitch_rad) + " rad, roll " +
               two_decimals(config.camera_roll_rad) + " rad, yaw " +
               two_decimals(config.camera_yaw_rad) + " rad (pose.camera_*)";
  return level;
}

}  // namespace

Eigen::Vector3d up_of_camera(double pitch_rad, double roll_rad) {
  // In the camera frame y points down; pitching down by a turns up from -y towards -z, rolling to
  // the right turns it towards -x.
  return {-std::sin(roll_rad) * std::cos(pitch_rad), -std::cos(roll_rad) * std::cos(pitch_rad),
          -std::sin(pitch_rad)};
}

Se3 given_camera(PoseConfig const& config) {
  Eigen::Vector3d const up = up_of_camera(config.camera_pitch_rad, config.camera_roll_rad);
  Eigen::AngleAxisd const yaw(config.camera_yaw_rad, Eigen::Vector3d::UnitZ());
  return {Eigen::Quaterniond(yaw) * rotation_to_z(up),
          {config.camera_x_m, config.camera_y_m, config.camera_height_m}};
}

WorldLevel find_level(std::span<FramePtr const> frames, PoseConfig const& config) {
  if (config.level == LevelMode::kOff) {
    return {Se3{}, true, "source taken as level (pose.level: off)"};
  }
  if (config.level == LevelMode::kGiven) {
    return level_as_given(frames.empty() ? Frame{} : *frames.front(), config);
  }
  for (FramePtr const& frame : frames) {
    CoarseCloud const coarse = coarse_cloud(frame->cloud_camera);
    if (std::optional<Plane> const floor = find_floor(coarse)) {
      return level_by_floor(*floor, coarse, *frame, config.level);
    }
  }
  return level_by_config(frames.empty() ? Frame{} : *frames.front(), config);
}

}  // namespace credo
