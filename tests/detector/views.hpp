#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "core/object_model.hpp"
#include "core/se3.hpp"
#include "core/sim_config.hpp"
#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo::test {

/// Of boxes, 16 cm long, like no turned copy of itself.
ObjectModel bracket();
/// A box that stands on the centre of its base; its half turns are symmetries.
ObjectModel crate(Eigen::Vector3d const& size_m);
/// A box that passes for one whose half turn is a symmetry, though one half of its top is higher.
ObjectModel nearly_symmetric_box();
/// A cylinder, symmetric about its axis.
ObjectModel can(double radius_m, double height_m);

/// Prepared once for all tests of a process.
SearchModel const& prepared_bracket();

/// Something in the world, z up.
struct Placed {
  ObjectModel model;
  Se3 T_world_model;
};

Se3 placed_at(Eigen::Vector3d const& position_m, double yaw_rad = 0.0);

/// A desk whose top is z = 0, and a floor beneath it.
std::vector<Placed> desk_and_floor();

/// T_world_camera of one that looks at a point.
Se3 looking_at(Eigen::Vector3d const& position_m, Eigen::Vector3d const& at_m);
/// A camera that looks at the desk from 1 m away.
Se3 before_desk();

struct Shot {
  SensorModel sensor = SensorModel::kIdeal;
  int seed = 1;
  std::int64_t index = 0;
};

/// What a camera of 640 x 480 pixels sees of the things, by casting rays.
FramePtr frame_of(std::vector<Placed> const& things, Se3 const& T_world_camera,
                  Shot const& shot = {});

/// A bracket on the desk, seen well.
struct BracketView {
  FramePtr frame;
  SearchScene scene;
  Se3 T_camera_model;
  /// The same in floats.
  CameraPose truth;
};
BracketView bracket_on_desk(double yaw_rad, Shot const& shot = {});
/// Floating before nothing, turned any way, 0.9 m away.
BracketView bracket_alone(Eigen::Quaterniond const& rotation, Shot const& shot = {});

/// Mean distance between the model's points at two poses [m].
double mean_distance_m(SearchModel const& model, CameraPose const& a, CameraPose const& b);
/// Angle between them [rad].
double angle_between(CameraPose const& a, CameraPose const& b);

/// Moved by a shift and turned about the model's centre, camera frame.
CameraPose perturbed(SearchModel const& model, CameraPose const& pose,
                     Eigen::Vector3f const& shift_m, Eigen::Vector3f const& turn_rad);

}  // namespace credo::test
