#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "core/label.hpp"
#include "core/se3.hpp"

namespace credo {

// What is truly there in a frame. World frame. An instance keeps its label for the whole scene,
// also while it is out of view or absent.

struct TrueFloor {
  /// Unit, up.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double height_m = 0.0;
};

struct TrueWall {
  std::string id;
  Eigen::Vector2d segment_start_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d segment_end_m = Eigen::Vector2d::Zero();
  /// Unit, of the side that faces the camera.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double visible_fraction = 0.0;
  LabelCode label = kFirstWall;
};

/// A known object, or stuff.
struct TrueThing {
  std::string id;
  /// Of an object: its model's name; else empty.
  std::string type;
  /// Where it stands, or stood last; before it appears, where it will.
  Se3 pose;
  bool present = true;
  /// Of what the camera would see of it alone, in a picture without edges.
  double visible_fraction = 0.0;
  LabelCode label = kFirstStuff;
};

struct TrueEvent {
  /// "appeared", "moved" or "removed".
  std::string what;
  std::string id;
};

struct FrameTruth {
  FrameIndex frame{0};
  std::int64_t stamp_ns = 0;
  /// Where the camera truly is.
  Se3 T_world_camera;
  std::optional<TrueFloor> floor;
  std::vector<TrueWall> walls;
  std::vector<TrueThing> objects;
  std::vector<TrueThing> stuff;
  /// What happened since the frame before; in the first frame nothing.
  std::vector<TrueEvent> events;
};

}  // namespace credo
