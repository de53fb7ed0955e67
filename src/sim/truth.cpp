#include "sim/truth.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "sim/camera_path.hpp"
#include "sim/scene_time.hpp"
#include "sim/thing.hpp"
#include "sim/visibility.hpp"

namespace credo {
namespace {

constexpr std::array<char const*, 4> kChangeWords = {"appeared", "moved", "removed", "moved"};

TrueFloor floor_of(SceneThing const& thing) {
  Se3 const T_world_thing = pose_of(thing);
  TrueFloor floor;
  floor.normal = T_world_thing.rotation() * Eigen::Vector3d::UnitZ();
  floor.height_m = (T_world_thing * Eigen::Vector3d(0, 0, bounds_of_thing(thing).max().z())).z();
  return floor;
}

TrueWall wall_of(SceneThing const& thing, Eigen::Vector3d const& eye_world) {
  Eigen::AlignedBox3d const box = bounds_of_thing(thing);
  Se3 const T_world_thing = pose_of(thing);
  bool const thin_in_x = box.sizes().x() < box.sizes().y();
  Eigen::Index const across = thin_in_x ? 0 : 1;
  Eigen::Index const along = thin_in_x ? 1 : 0;
  Eigen::Vector3d const eye_thing = T_world_thing.inverse() * eye_world;
  bool const beyond = eye_thing[across] > box.center()[across];
  Eigen::Vector3d start = box.min();
  start[across] = beyond ? box.max()[across] : box.min()[across];
  Eigen::Vector3d end = start;
  end[along] = box.max()[along];
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  normal[across] = beyond ? 1.0 : -1.0;
  TrueWall wall;
  wall.id = thing.name;
  wall.segment_start_m = (T_world_thing * start).head<2>();
  wall.segment_end_m = (T_world_thing * end).head<2>();
  wall.normal = T_world_thing.rotation() * normal;
  return wall;
}

/// What happened since the frame before. A swap moves two things.
std::vector<TrueEvent> events_of(Scene const& scene, FrameIndex index) {
  std::vector<TrueEvent> events;
  if (number(index) == 0) {
    return events;
  }
  double const before_s = scene_time_s(scene, FrameIndex{number(index) - 1});
  std::size_t const end = event_count_at(scene, scene_time_s(scene, index));
  for (std::size_t i = event_count_at(scene, before_s); i < end; ++i) {
    SceneEvent const& event = scene.events[i];
    events.push_back({kChangeWords.at(static_cast<std::size_t>(event.what)), event.thing});
    if (event.what == SceneChange::kSwapped) {
      events.push_back({events.back().what, event.with});
    }
  }
  for (std::size_t const thing : motions_at(scene, index)) {
    events.push_back({"moved", scene.things[thing].name});
  }
  return events;
}

/// Of each thing.
std::vector<double> visible_fractions(RayCaster const& world, Se3 const& T_world_camera) {
  std::vector<double> shares(world.things().size());
  tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t thing) {
    shares[thing] = visible_fraction(world, thing, T_world_camera);
  });
  return shares;
}

}  // namespace

std::vector<LabelCode> labels_of_things(Scene const& scene) {
  std::array<LabelCode, 4> next = {kFloor, kFirstWall, kFirstObject, kFirstStuff};
  std::array<std::size_t, 4> left = {scene.things.size(), kMaxWalls, kMaxObjects, kMaxStuff};
  std::vector<LabelCode> labels;
  for (SceneThing const& thing : scene.things) {
    auto const kind = static_cast<std::size_t>(thing.kind);
    if (left.at(kind)-- == 0) {
      throw InputError("scene " + scene.name + ": too many things of the kind of " + thing.name +
                       " for a label image");
    }
    labels.push_back(next.at(kind));
    if (thing.kind != SceneKind::kGround) {
      ++next.at(kind);
    }
  }
  return labels;
}

FrameTruth truth_of(SceneCaster& world, FrameIndex index) {
  Scene const& scene = world.scene();
  double const time_s = scene_time_s(scene, index);
  double const since_s = time_s - scene_time_s(scene, FrameIndex{0});
  std::vector<LabelCode> const labels = labels_of_things(scene);
  FrameTruth truth;
  truth.frame = index;
  truth.stamp_ns = static_cast<std::int64_t>(std::llround(since_s * 1e9));
  truth.T_world_camera = camera_pose(scene.camera.path, time_s);
  RayCaster const& caster = world.at(time_s);
  std::vector<double> const visible = visible_fractions(caster, truth.T_world_camera);
  for (std::size_t i = 0; i < scene.things.size(); ++i) {
    bool const present = caster.things()[i].has_value();
    SceneThing const thing = present ? *caster.things()[i] : last_known(scene, i, time_s);
    switch (thing.kind) {
      case SceneKind::kGround:
        if (present) {
          truth.floor = floor_of(thing);
        }
        break;
      case SceneKind::kWall:
        if (present) {
          TrueWall wall = wall_of(thing, truth.T_world_camera.translation());
          wall.visible_fraction = visible[i];
          wall.label = labels[i];
          truth.walls.push_back(std::move(wall));
        }
        break;
      case SceneKind::kObject:
      case SceneKind::kStuff: {
        bool const object = thing.kind == SceneKind::kObject;
        (object ? truth.objects : truth.stuff)
            .push_back({thing.name, object ? type_of(thing) : std::string(), pose_of(thing),
                        present, visible[i], labels[i]});
        break;
      }
    }
  }
  truth.events = events_of(scene, index);
  return truth;
}

FrameTruth truth_of(Scene const& scene, FrameIndex index) {
  SceneCaster world(scene);
  return truth_of(world, index);
}

LabelMap true_labels(Scene const& scene, RenderedView const& view, Grid<float> const& measured_m) {
  std::vector<LabelCode> const labels = labels_of_things(scene);
  LabelMap image(view.thing.width(), view.thing.height(), kNoDepth);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!(measured_m[i] > 0.0F) || view.thing[i] < 0) {
      continue;
    }
    // Glass returns nothing: what is measured there comes from beside it.
    auto const thing = static_cast<std::size_t>(view.thing[i]);
    if (scene.things[thing].surface != SceneSurface::kGlass) {
      image[i] = labels[thing];
    }
  }
  return image;
}

}  // namespace credo
