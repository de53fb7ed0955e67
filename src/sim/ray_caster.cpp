#include "sim/ray_caster.hpp"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "geometry/solid.hpp"
#include "sim/scene_time.hpp"
#include "sim/thing.hpp"

namespace credo {
namespace {

constexpr int kLanes = 8;
constexpr Rgb kNothing = {20, 20, 24};
/// Embree's boxes around the bodies are in floats: wider by this they never lose a hit.
constexpr double kBoundsMargin_m = 1e-3;

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using BodyTree = std::unique_ptr<RTCSceneTy, ReleaseScene>;

/// One convex body; its position in the list is its Embree number.
struct Body {
  Solid solid;
  std::int32_t thing = 0;
  Se3 T_world_thing;
  Eigen::Vector3d to_lamp_thing;
  Eigen::Vector3f color;
  double checker_m = 0.0;
};

/// A body and where the camera stands before it: rays are followed in the thing's frame.
struct BodyView {
  Body const* body = nullptr;
  Eigen::Matrix3d R_thing_camera;
  Eigen::Vector3d eye_thing;
};

/// Some rays through neighbouring pixels, and what each has hit first so far. Embree hands it
/// through to intersect_body.
struct RayPacket {
  RTCIntersectContext context;  // Embree knows the packet by this: it must come first
  std::vector<BodyView> const* views = nullptr;
  /// Of length 1 along the optical axis, so that distances are depths.
  std::array<Eigen::Vector3d, kLanes> rays_camera;
  std::array<RayEntry, kLanes> entries;
  std::array<unsigned, kLanes> bodies{};
};

/// The world's axis-aligned box around a body, for Embree's tree.
void bound_body(RTCBoundsFunctionArguments const* arguments) {
  auto const& body = *static_cast<Body const*>(arguments->geometryUserPtr);
  Eigen::AlignedBox3d const box_thing = bounds_of(body.solid);
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    box.extend(body.T_world_thing *
               box_thing.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  Eigen::Vector3f const low = (box.min().array() - kBoundsMargin_m).cast<float>();
  Eigen::Vector3f const high = (box.max().array() + kBoundsMargin_m).cast<float>();
  *arguments->bounds_o = {low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), 0};
}

/// Takes a body into the rays of a packet that may hit it. Depths are compared in doubles, the
/// first body wins a draw: the order in which Embree asks does not matter.
void intersect_body(RTCIntersectFunctionNArguments const* arguments) {
  auto& packet = *reinterpret_cast<RayPacket*>(arguments->context);
  BodyView const& view = (*packet.views)[arguments->geomID];
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) {
      continue;
    }
    std::size_t const lane = RTCRayN_id(rays, arguments->N, i);
    std::optional<RayEntry> const entry =
        enter(view.body->solid, view.eye_thing, view.R_thing_camera * packet.rays_camera[lane]);
    RayEntry& first = packet.entries[lane];
    if (entry.has_value() &&
        (entry->distance < first.distance ||
         (entry->distance == first.distance && arguments->geomID < packet.bodies[lane]))) {
      first = *entry;
      packet.bodies[lane] = arguments->geomID;
      RTCRayN_tfar(rays, arguments->N, i) = static_cast<float>(entry->distance);
    }
  }
}

/// Some light from everywhere, some from a far lamp overhead, some from the camera (Lambert), so
/// that every edge shows; a checkerboard lies in the thing's own axes.
Rgb shade(Body const& body, RayEntry const& entry, Eigen::Vector3d const& p_thing,
          double camera_cosine) {
  double const lamp_cosine = std::max(0.0, entry.normal.dot(body.to_lamp_thing));
  auto light = static_cast<float>(0.42 + 0.3 * lamp_cosine + 0.28 * camera_cosine);
  if (body.checker_m > 0.0) {
    // The small shift keeps a face that lies on a border of cells in one of them.
    Eigen::Vector3d const cell = (p_thing.array() / body.checker_m + 1e-4).floor();
    light *= std::fmod(cell.sum(), 2.0) != 0.0 ? 0.72F : 1.0F;
  }
  Eigen::Vector3f const lit = (body.color * light).cwiseMin(255.0F);
  return {static_cast<std::uint8_t>(lit.x()), static_cast<std::uint8_t>(lit.y()),
          static_cast<std::uint8_t>(lit.z())};
}

}  // namespace

struct RayCaster::World {
  SceneCamera camera;
  std::vector<Body> bodies;
  Device device;
  BodyTree tree;

  World(Scene const& scene, double time_s);
  void render_row(Se3 const& T_world_camera, std::vector<BodyView> const& views, int v,
                  RenderedView& view) const;
  void take_hit(RayPacket const& packet, std::size_t lane, Pixel pixel, RenderedView& view) const;
};

RayCaster::World::World(Scene const& scene, double time_s)
    : camera(scene.camera), device(rtcNewDevice(nullptr)), tree(rtcNewScene(device.get())) {
  if (tree == nullptr) {
    throw std::runtime_error("Embree does not start on this machine");
  }
  Eigen::Vector3d const to_lamp_world = Eigen::Vector3d(-0.35, -0.25, 0.9).normalized();
  PresentThings const things = things_at(scene, time_s);
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (!things[i].has_value()) {
      continue;
    }
    SceneThing const& thing = *things[i];
    Se3 const T_world_thing = pose_of(thing);
    for (Solid const& solid : solids_of(thing)) {
      bodies.push_back(
          {solid, static_cast<std::int32_t>(i), T_world_thing,
           T_world_thing.rotation().conjugate() * to_lamp_world,
           Eigen::Vector3d(thing.color[0], thing.color[1], thing.color[2]).cast<float>(),
           thing.checker_m});
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    RTCGeometry body = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(body, 1);
    rtcSetGeometryUserData(body, &bodies[i]);
    rtcSetGeometryBoundsFunction(body, bound_body, nullptr);
    rtcSetGeometryIntersectFunction(body, intersect_body);
    rtcCommitGeometry(body);
    rtcAttachGeometryByID(tree.get(), body, static_cast<unsigned>(i));
    rtcReleaseGeometry(body);
  }
  rtcCommitScene(tree.get());
}

void RayCaster::World::take_hit(RayPacket const& packet, std::size_t lane, Pixel pixel,
                                RenderedView& view) const {
  BodyView const& body_view = (*packet.views)[packet.bodies[lane]];
  RayEntry const& entry = packet.entries[lane];
  view.thing[pixel] = body_view.body->thing;
  if (entry.distance >= camera.min_range_m && entry.distance <= camera.max_range_m) {
    view.depth_m[pixel] = static_cast<float>(entry.distance);
  }
  Eigen::Vector3d const ray_thing = body_view.R_thing_camera * packet.rays_camera[lane];
  double const camera_cosine = std::abs(entry.normal.dot(ray_thing)) / ray_thing.norm();
  view.incidence_cosine[pixel] = static_cast<float>(camera_cosine);
  view.color[pixel] = shade(*body_view.body, entry,
                            body_view.eye_thing + entry.distance * ray_thing, camera_cosine);
}

void RayCaster::World::render_row(Se3 const& T_world_camera, std::vector<BodyView> const& views,
                                  int v, RenderedView& view) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Eigen::Matrix3d const R_world_camera = T_world_camera.rotation().toRotationMatrix();
  Eigen::Vector3f const eye_world = T_world_camera.translation().cast<float>();
  RayPacket packet;
  packet.views = &views;
  rtcInitIntersectContext(&packet.context);
  packet.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int first = 0; first < camera.width_px; first += kLanes) {
    RTCRayHit8 rays{};
    alignas(32) std::array<int, kLanes> valid{};  // Embree loads it whole
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      int const u = first + static_cast<int>(lane);
      valid[lane] = u < camera.width_px ? -1 : 0;
      packet.rays_camera[lane] = {(u - camera.cx_px) / camera.fx_px,
                                  (v - camera.cy_px) / camera.fy_px, 1.0};
      packet.entries[lane].distance = kFar;
      packet.bodies[lane] = RTC_INVALID_GEOMETRY_ID;
      Eigen::Vector3f const ray = (R_world_camera * packet.rays_camera[lane]).cast<float>();
      rays.ray.org_x[lane] = eye_world.x();
      rays.ray.org_y[lane] = eye_world.y();
      rays.ray.org_z[lane] = eye_world.z();
      rays.ray.dir_x[lane] = ray.x();
      rays.ray.dir_y[lane] = ray.y();
      rays.ray.dir_z[lane] = ray.z();
      rays.ray.tfar[lane] = std::numeric_limits<float>::infinity();
      rays.ray.mask[lane] = ~0U;
      rays.ray.id[lane] = static_cast<unsigned>(lane);
      rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid.data(), tree.get(), &packet.context, &rays);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (valid[lane] != 0 && packet.bodies[lane] != RTC_INVALID_GEOMETRY_ID) {
        take_hit(packet, lane, {first + static_cast<int>(lane), v}, view);
      }
    }
  }
}

RayCaster::RayCaster(Scene const& scene, double time_s) {
  check_scene(scene);
  world_ = std::make_unique<World>(scene, time_s);
}

RayCaster::~RayCaster() = default;

RenderedView RayCaster::render(Se3 const& T_world_camera) const {
  int const width = world_->camera.width_px;
  int const height = world_->camera.height_px;
  RenderedView view{Grid<float>(width, height), Grid<Rgb>(width, height, kNothing),
                    Grid<std::int32_t>(width, height, -1), Grid<float>(width, height)};
  std::vector<BodyView> body_views;
  for (Body const& body : world_->bodies) {
    Se3 const T_thing_camera = body.T_world_thing.inverse() * T_world_camera;
    body_views.push_back(
        {&body, T_thing_camera.rotation().toRotationMatrix(), T_thing_camera.translation()});
  }
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](auto const& rows) {
    for (int v = rows.begin(); v < rows.end(); ++v) {
      world_->render_row(T_world_camera, body_views, v, view);
    }
  });
  return view;
}

}  // namespace credo
