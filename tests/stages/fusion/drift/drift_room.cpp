#include "stages/fusion/drift/drift_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "geometry/sight.hpp"
#include "stages/fusion/stuff/model.hpp"

namespace credo::test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
CameraIntrinsics const kCamera{130, 130, 79.5, 59.5};
constexpr double kWallAtX_m = 4.0;
constexpr double kWallAtY_m = 2.0;

struct Hit {
  double depth_m = std::numeric_limits<double>::infinity();
  LabelCode label = kNoDepth;
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();
};

void meet_plane(Plane const& plane, LabelCode label, Eigen::Vector3d const& eye,
                Eigen::Vector3d const& ray, Hit& hit) {
  double const depth_m = -plane.signed_distance_m(eye) / plane.normal.dot(ray);
  if (depth_m > 0.0 && depth_m < hit.depth_m) {
    hit = {depth_m, label, plane.normal};
  }
}

void meet_crate(Crate const& crate, LabelCode label, Eigen::Vector3d const& eye,
                Eigen::Vector3d const& ray, Hit& hit) {
  double in_m = 0.0;
  double out_m = std::numeric_limits<double>::infinity();
  int side = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double const a = (crate.min_m[axis] - eye[axis]) / ray[axis];
    double const b = (crate.max_m[axis] - eye[axis]) / ray[axis];
    if (std::min(a, b) > in_m) {
      in_m = std::min(a, b);
      side = axis;
    }
    out_m = std::min(out_m, std::max(a, b));
  }
  if (in_m > 0.0 && in_m < out_m && in_m < hit.depth_m) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    normal[side] = ray[side] > 0.0 ? -1.0 : 1.0;
    hit = {in_m, label, normal};
  }
}

std::vector<Plane> walls_of(DriftRoom const& room) {
  std::vector<Plane> walls = {{-Eigen::Vector3d::UnitX(), -kWallAtX_m},
                              {-Eigen::Vector3d::UnitY(), -kWallAtY_m}};
  walls.resize(room.walls);
  return walls;
}

Hit hit_of(DriftRoom const& room, Eigen::Vector3d const& eye, Eigen::Vector3d const& ray) {
  Hit hit;
  if (room.floor) {
    meet_plane({}, kFloor, eye, ray, hit);
  }
  std::vector<Plane> const walls = walls_of(room);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    meet_plane(walls[i], static_cast<LabelCode>(kFirstWall + i), eye, ray, hit);
  }
  for (std::size_t i = 0; i < room.crates.size(); ++i) {
    meet_crate(room.crates[i], static_cast<LabelCode>(kFirstStuff + i), eye, ray, hit);
  }
  return hit;
}

/// Points of what the frame shows under a label.
PointList points_of(Segmentation const& frame, LabelCode label) {
  PointList points;
  for (std::size_t i = 0; i < frame.labels.size(); ++i) {
    if (frame.labels[i] == label) {
      Pixel const pixel = frame.labels.pixel(i);
      double const z_m = frame.sight.depth_m[i];
      Eigen::Vector3d const p((pixel.u - kCamera.cx_px) / kCamera.fx_px * z_m,
                              (pixel.v - kCamera.cy_px) / kCamera.fy_px * z_m, z_m);
      points.push_back((frame.T_world_camera * p).cast<float>());
    }
  }
  return points;
}

void add_observations(DriftRoom const& room, Segmentation& frame, Se3 const& T_world_true) {
  if (PointList points = points_of(frame, kFloor); !points.empty()) {
    frame.floor = FloorObservation{transformed(T_world_true, Plane{}), std::move(points), 1};
  }
  std::vector<Plane> const walls = walls_of(room);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    auto const label = static_cast<LabelCode>(kFirstWall + i);
    frame.walls.push_back({label, transformed(T_world_true, walls[i]), points_of(frame, label), 1});
  }
  for (std::size_t i = 0; i < room.crates.size(); ++i) {
    StuffCluster& cluster = frame.stuff.emplace_back();
    cluster.label = static_cast<LabelCode>(kFirstStuff + i);
    cluster.points_world = points_of(frame, cluster.label);
    cluster.pixel_count = cluster.points_world.size();
  }
}

}  // namespace

std::vector<Crate> crates(std::size_t count) {
  std::vector<Crate> all = {
      {{2.6, 0.2, 0.0}, {3.0, 0.7, 0.5}},   {{1.9, 0.9, 0.0}, {2.2, 1.2, 0.3}},
      {{2.9, -0.6, 0.0}, {3.2, -0.2, 0.7}}, {{2.4, 1.4, 0.0}, {2.7, 1.8, 0.9}},
      {{1.7, -0.4, 0.0}, {2.0, 0.0, 0.25}}, {{3.3, 1.0, 0.0}, {3.6, 1.4, 1.1}}};
  all.resize(std::min(count, all.size()), all.front());
  return all;
}

Se3 looking_into_the_corner() {
  Eigen::Vector3d const eye(0.3, -0.8, 1.5);
  Eigen::Vector3d const forward = (Eigen::Vector3d(2.8, 0.7, 0.3) - eye).normalized();
  Eigen::Vector3d const right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d R;
  R << right, forward.cross(right), forward;
  return {Eigen::Quaterniond(R), eye};
}

Segmentation frame_of(DriftRoom const& room, Se3 const& T_world_camera, Se3 const& T_told_camera) {
  Segmentation frame;
  frame.T_world_camera = T_told_camera;
  frame.labels = LabelMap(kWidth, kHeight, kNoDepth);
  Grid<float> depth_m(kWidth, kHeight);
  NormalMap normals(kWidth, kHeight);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    Pixel const pixel = depth_m.pixel(i);
    Eigen::Vector3d const ray((pixel.u - kCamera.cx_px) / kCamera.fx_px,
                              (pixel.v - kCamera.cy_px) / kCamera.fy_px, 1.0);
    Hit const hit = hit_of(room, T_world_camera.translation(), T_world_camera.rotation() * ray);
    if (hit.label != kNoDepth) {
      depth_m[i] = static_cast<float>(hit.depth_m);
      frame.labels[i] = hit.label;
      normals.set(i, (T_world_camera.rotation().inverse() * hit.normal_world).cast<float>());
    }
  }
  frame.sight = sight_of(depth_m, frame.labels, kCamera);
  frame.sight.normals_camera = middle_normals(normals, frame.sight);
  add_observations(room, frame, T_told_camera * T_world_camera.inverse());
  return frame;
}

BeliefState belief_of(DriftRoom const& room, Se3 const& T_world_camera) {
  Segmentation const frame = frame_of(room, T_world_camera, T_world_camera);
  BeliefState belief;
  if (frame.floor) {
    belief.floor.emplace();
    belief.floor->points = std::make_shared<PointList const>(frame.floor->points_world);
  }
  for (WallObservation const& seen : frame.walls) {
    WallBelief& wall = belief.walls.emplace_back();
    wall.plane_world = seen.plane_world;
    wall.segment_start_m = Eigen::Vector2d(kWallAtX_m, kWallAtY_m);
    wall.segment_end_m = seen.label == kFirstWall ? Eigen::Vector2d(kWallAtX_m, -1.5)
                                                  : Eigen::Vector2d(0.0, kWallAtY_m);
  }
  for (StuffCluster const& cluster : frame.stuff) {
    StuffBelief& item = belief.stuff.emplace_back();
    item.log_odds = 4.0;
    item.history_count = 10;
    item.model = std::make_shared<StuffModel const>(new_model(cluster.points_world, 0.1));
  }
  return belief;
}

}  // namespace credo::test
