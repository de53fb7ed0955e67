#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/fields.hpp"
#include "core/object_model.hpp"
#include "core/sim_config.hpp"

namespace credo {

enum class SceneShape : std::uint8_t {
  kBox,       // size x, y, z
  kCylinder,  // size radius, height
  kSphere,    // size radius
  kTable,     // size x, y, height, thickness of the top, side of a leg
};

/// How its surface returns the light of a depth camera.
enum class SceneSurface : std::uint8_t {
  kMatte,
  kDark,   // too little of it, far away
  kShiny,  // like a mirror: too much or none
  kGlass,  // none at all
};

/// What a thing is to the belief.
enum class SceneKind : std::uint8_t { kGround, kWall, kObject, kStuff };

/// A pattern in the colour of a thing, in its own frame (texture_shade). Depth does not change.
struct SceneTexture {
  enum class Kind : std::uint8_t { kPlain, kChecker, kStripes, kNoise };
  Kind kind = Kind::kPlain;
  /// Side of a square, width of a stripe, or about that of a blotch.
  double size_m = 0.1;
};
FieldList fields(SceneTexture& texture);

/// Where a thing that moves is at a time.
struct ThingWaypoint {
  /// On the clock of the camera's waypoints.
  double time_s = 0.0;
  std::vector<double> position_m = {0, 0, 0};
  /// How far it is turned about the world's z, beyond the thing's own turn.
  double yaw_deg = 0.0;
};
FieldList fields(ThingWaypoint& waypoint);

/// One thing of a scene. It stands on the centre of its base, z up, before it is turned and moved.
struct SceneThing {
  std::string name;
  SceneKind kind = SceneKind::kStuff;
  /// Of an object: the name of the model that a prior calls it by. Empty: that of `model`, or its
  /// own name (type_of).
  std::string type;
  /// What it looks like, by the name or the file of a model of known objects, instead of shape and
  /// size_m; it keeps the model's frame.
  std::string model;
  /// The model of that name; whoever reads the scene's file loads it.
  std::shared_ptr<ObjectModel const> loaded_model;
  SceneShape shape = SceneShape::kBox;
  std::vector<double> size_m;
  std::vector<double> position_m = {0, 0, 0};
  /// Turns about the fixed axes x, y, z.
  std::vector<double> rpy_deg = {0, 0, 0};
  /// In order of time. Between two of them it moves straight and evenly; before the first and after
  /// the last it rests. Empty: it stands at position_m.
  std::vector<ThingWaypoint> path;
  /// 0 to 255.
  std::vector<double> color = {180, 180, 180};
  SceneTexture texture;
  /// The short way to write a checkerboard: the side of its squares; 0 for none.
  double checker_m = 0.0;
  SceneSurface surface = SceneSurface::kMatte;
};
FieldList fields(SceneThing& thing);

/// Where the camera is at a time, and what it looks at; it passes through all of them smoothly.
struct SceneWaypoint {
  double time_s = 0.0;
  std::vector<double> position_m = {0, 0, 1};
  std::vector<double> look_at_m = {1, 0, 0};
};
FieldList fields(SceneWaypoint& waypoint);

struct SceneCamera {
  int width_px = 640;
  int height_px = 480;
  double fx_px = 525.0;
  double fy_px = 525.0;
  double cx_px = 319.5;
  double cy_px = 239.5;
  double frames_per_s = 30.0;
  double min_range_m = 0.4;
  double max_range_m = 8.0;
  SensorModel sensor = SensorModel::kIdeal;
  // How far the pose that it tells strays from the true one: jitter anew in each frame, standard
  // deviations along and about each axis, and drift growing with time, along the world's x and y
  // and about its z.
  double pose_jitter_m = 0.0;
  double pose_jitter_rad = 0.0;
  double pose_drift_m_per_s = 0.0;
  double pose_drift_rad_per_s = 0.0;
  std::vector<SceneWaypoint> path;
};
FieldList fields(SceneCamera& camera);

enum class SceneChange : std::uint8_t { kAppeared, kMoved, kRemoved, kSwapped };

/// What happens to a thing, seen from the first frame at or after its time. A thing whose first
/// event is that it appears is absent before.
struct SceneEvent {
  /// On the clock of the waypoints.
  double time_s = 0.0;
  /// Its name.
  std::string thing;
  SceneChange what = SceneChange::kMoved;
  /// Of a swap: the name of the thing that it trades places with. Each keeps its turn.
  std::string with;
  /// Where it stands from then on, three numbers. Empty: it appears where Scene::things has it.
  std::vector<double> position_m;
  /// Three numbers. Empty: what moves keeps its turn, what appears has that of Scene::things.
  std::vector<double> rpy_deg;
};
FieldList fields(SceneEvent& event);

/// A simulated world, z up, floor at z = 0, and the way a camera takes through it.
struct Scene {
  std::string name;
  std::vector<SceneThing> things;
  /// In order of time.
  std::vector<SceneEvent> events;
  SceneCamera camera;
};
FieldList fields(Scene& scene);

/// Throws InputError naming the thing that cannot be: sizes missing or not positive, names twice,
/// no things, a type without an object, a model not loaded or a size beside it, two textures, no
/// camera path, times that do not rise, a camera that looks at where it is, an event of a thing
/// that is unknown, or absent, or there already, a swap with itself, a place for what has a path.
void check_scene(Scene const& scene);

/// The file of a scene given by name (scenes/NAME.yaml of this project) or as a path. Throws
/// InputError that lists the known names.
std::filesystem::path find_scene(std::string const& name_or_file);

}  // namespace credo
