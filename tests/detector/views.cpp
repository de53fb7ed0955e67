#include "detector/views.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "detector/scenes/scene_of_frame.hpp"
#include "sim/camera_path.hpp"
#include "sim/depth_sensor.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scene.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

SceneThing thing_of(Placed const& placed, std::size_t position) {
  SceneThing thing;
  thing.name = "thing-" + std::to_string(position);
  thing.model = "made here";
  thing.loaded_model = std::make_shared<ObjectModel const>(placed.model);
  Vector3d const& p = placed.T_world_model.translation();
  thing.position_m = {p.x(), p.y(), p.z()};
  Eigen::Matrix3d const R = placed.T_world_model.rotation().toRotationMatrix();
  double const degrees = 180.0 / std::numbers::pi;
  thing.rpy_deg = {degrees * std::atan2(R(2, 1), R(2, 2)),
                   degrees * std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
                   degrees * std::atan2(R(1, 0), R(0, 0))};
  return thing;
}

BracketView view_of(std::vector<Placed> const& things, Se3 const& T_world_camera,
                    Se3 const& T_world_model, Shot const& shot) {
  BracketView view;
  view.frame = frame_of(things, T_world_camera, shot);
  view.scene = scene_of(*view.frame);
  view.T_camera_model = T_world_camera.inverse() * T_world_model;
  view.truth = camera_pose(view.T_camera_model);
  return view;
}

}  // namespace

ObjectModel bracket() {
  return {"bracket",
          std::vector<Solid>{BoxSolid{{-0.08, -0.04, 0.0}, {0.08, 0.04, 0.03}},
                             BoxSolid{{-0.08, -0.04, 0.03}, {-0.045, 0.04, 0.12}},
                             BoxSolid{{0.02, 0.0, 0.03}, {0.06, 0.04, 0.075}}},
          {}};
}

ObjectModel crate(Vector3d const& size_m) {
  Symmetry symmetry;
  symmetry.rotations = {Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitZ()))};
  return {"crate", std::vector<Solid>{box_on_base(size_m)}, symmetry};
}

ObjectModel nearly_symmetric_box() {
  Symmetry symmetry;
  symmetry.rotations = {Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitZ()))};
  return {"box",
          std::vector<Solid>{BoxSolid{{-0.09, -0.05, 0.0}, {0.09, 0.05, 0.06}},
                             BoxSolid{{0.0, -0.05, 0.06}, {0.09, 0.05, 0.068}}},
          symmetry};
}

ObjectModel can(double radius_m, double height_m) {
  Symmetry symmetry;
  symmetry.axis = SymmetryAxis{};
  return {"can", std::vector<Solid>{CylinderSolid{radius_m, height_m}}, symmetry};
}

SearchModel const& prepared_bracket() {
  static SearchModel const model = prepare_model(bracket());
  return model;
}

Se3 placed_at(Vector3d const& position_m, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ())), position_m};
}

std::vector<Placed> desk_and_floor() {
  ObjectModel const desk{
      "desk", std::vector<Solid>{BoxSolid{{-0.6, -0.4, -0.03}, {0.6, 0.4, 0.0}}}, {}};
  ObjectModel const floor{
      "floor", std::vector<Solid>{BoxSolid{{-3.0, -3.0, -0.8}, {3.0, 3.0, -0.75}}}, {}};
  return {{desk, {}}, {floor, {}}};
}

Se3 looking_at(Vector3d const& position_m, Vector3d const& at_m) {
  SceneWaypoint waypoint;
  waypoint.position_m = {position_m.x(), position_m.y(), position_m.z()};
  waypoint.look_at_m = {at_m.x(), at_m.y(), at_m.z()};
  return camera_pose({waypoint}, 0.0);
}

Se3 before_desk() {
  return looking_at({0.05, -0.8, 0.6}, {0.0, 0.0, 0.05});
}

FramePtr frame_of(std::vector<Placed> const& things, Se3 const& T_world_camera, Shot const& shot) {
  Scene scene;
  for (Placed const& placed : things) {
    scene.things.push_back(thing_of(placed, scene.things.size()));
  }
  scene.camera.path = {SceneWaypoint{}};
  RenderedView const view = RayCaster(scene).render(T_world_camera);
  auto frame = std::make_shared<Frame>();
  frame->index = FrameIndex{shot.index};
  frame->T_source_camera = T_world_camera;
  frame->cloud_camera = cloud_from_depth(
      measured_depth(view, scene, shot.sensor, shot.seed, frame->index), frame->intrinsics);
  return frame;
}

BracketView bracket_on_desk(double yaw_rad, Shot const& shot) {
  std::vector<Placed> things = desk_and_floor();
  Se3 const T_world_model = placed_at({0.0, 0.0, 0.0}, yaw_rad);
  things.push_back({bracket(), T_world_model});
  return view_of(things, before_desk(), T_world_model, shot);
}

BracketView bracket_alone(Eigen::Quaterniond const& rotation, Shot const& shot) {
  Se3 const T_camera_model(rotation, {0.02, -0.03, 0.9});
  return view_of({{bracket(), T_camera_model}}, {}, T_camera_model, shot);
}

double mean_distance_m(SearchModel const& model, CameraPose const& a, CameraPose const& b) {
  double sum = 0.0;
  for (Eigen::Vector3f const& p : model.points_model) {
    sum += static_cast<double>((a * p - b * p).norm());
  }
  return sum / static_cast<double>(model.points_model.size());
}

double angle_between(CameraPose const& a, CameraPose const& b) {
  return so3_log(se3(a).rotation().conjugate() * se3(b).rotation()).norm();
}

CameraPose perturbed(SearchModel const& model, CameraPose const& pose,
                     Eigen::Vector3f const& shift_m, Eigen::Vector3f const& turn_rad) {
  Eigen::Vector3f const centre = pose * model.centre_model;
  Eigen::Matrix3f const turn = so3_exp(turn_rad.cast<double>()).toRotationMatrix().cast<float>();
  return {turn * pose.rotation, turn * (pose.translation_m - centre) + centre + shift_m};
}

}  // namespace credo::test
