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
#include <span>
#include <stdexcept>
#include <tuple>
#include <variant>
#include <vector>

#include "geometry/shapes/mesh_edges.hpp"
#include "geometry/shapes/solid.hpp"
#include "geometry/shapes/triangle.hpp"
#include "sim/texture.hpp"
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

/// One convex body, or a mesh; its position in the list is its Embree number.
struct Body {
  std::variant<Solid, TriangleMesh const*> shape;
  std::size_t thing = 0;
  Se3 T_world_thing;
  Eigen::Vector3d to_lamp_thing;
  Eigen::Vector3f color;
  SceneTexture texture;
  std::uint32_t texture_seed = 0;
};

/// A body and where the camera stands before it: rays are followed in the thing's frame.
struct BodyView {
  Body const* body = nullptr;
  Eigen::Matrix3d R_thing_camera;
  Eigen::Vector3d eye_thing;
};

/// The world from where a camera stands.
struct Gaze {
  Gaze(std::vector<Body> const& bodies, Se3 const& T_world_camera,
       std::optional<std::size_t> only_thing = {})
      : R_world_camera(T_world_camera.rotation().toRotationMatrix()),
        eye_world(T_world_camera.translation().cast<float>()),
        only(only_thing) {
    for (Body const& body : bodies) {
      Se3 const T_thing_camera = body.T_world_thing.inverse() * T_world_camera;
      views.push_back(
          {&body, T_thing_camera.rotation().toRotationMatrix(), T_thing_camera.translation()});
    }
  }

  std::vector<BodyView> views;
  Eigen::Matrix3d R_world_camera;
  Eigen::Vector3f eye_world;
  /// All others are looked through.
  std::optional<std::size_t> only;
};

/// What a ray has hit first so far. Of equally near ones the first body, there the first triangle:
/// the order in which Embree asks does not matter.
struct Hit {
  RayEntry entry = {std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitZ()};
  unsigned body = RTC_INVALID_GEOMETRY_ID;
  unsigned part = 0;

  [[nodiscard]] bool before(Hit const& other) const {
    return std::tie(entry.distance, body, part) <
           std::tie(other.entry.distance, other.body, other.part);
  }
};

/// Some rays through neighbouring pixels. Embree hands it through to intersect_body.
struct RayPacket {
  RTCIntersectContext context;  // Embree knows the packet by this: it must come first
  Gaze const* gaze = nullptr;
  /// Of length 1 along the optical axis, so that distances are depths.
  std::array<Eigen::Vector3d, kLanes> rays_camera;
  std::array<Hit, kLanes> hits;
};

std::array<Eigen::Vector3d, 3> corners_of(TriangleMesh const& mesh, std::size_t triangle) {
  auto const& [a, b, c] = mesh.triangles[triangle];
  return {mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(),
          mesh.vertices[c].cast<double>()};
}

/// The world's axis-aligned box around a body or one triangle of a mesh, for Embree's tree.
void bound_body(RTCBoundsFunctionArguments const* arguments) {
  auto const& body = *static_cast<Body const*>(arguments->geometryUserPtr);
  Eigen::AlignedBox3d box;
  if (auto const* mesh = std::get_if<TriangleMesh const*>(&body.shape)) {
    for (Eigen::Vector3d const& corner : corners_of(**mesh, arguments->primID)) {
      box.extend(body.T_world_thing * corner);
    }
  } else {
    Eigen::AlignedBox3d const box_thing = bounds_of(std::get<Solid>(body.shape));
    for (int corner = 0; corner < 8; ++corner) {
      box.extend(body.T_world_thing *
                 box_thing.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
  }
  Eigen::Vector3f const low = (box.min().array() - kBoundsMargin_m).cast<float>();
  Eigen::Vector3f const high = (box.max().array() + kBoundsMargin_m).cast<float>();
  *arguments->bounds_o = {low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), 0};
}

std::optional<RayEntry> enter_triangle(TriangleMesh const& mesh, std::size_t triangle,
                                       Eigen::Vector3d const& origin,
                                       Eigen::Vector3d const& direction) {
  auto const distance = distance_to_triangle(corners_of(mesh, triangle), origin, direction);
  if (!distance.has_value()) {
    return std::nullopt;
  }
  Eigen::Vector3d const normal = area_vector(mesh, triangle).normalized();
  return RayEntry{*distance, normal.dot(direction) > 0.0 ? -normal : normal};
}

/// Takes a body, or one triangle of a mesh, into the rays of a packet that may hit it.
void intersect_body(RTCIntersectFunctionNArguments const* arguments) {
  auto& packet = *reinterpret_cast<RayPacket*>(arguments->context);
  BodyView const& view = packet.gaze->views[arguments->geomID];
  if (packet.gaze->only.value_or(view.body->thing) != view.body->thing) {
    return;
  }
  auto const* mesh = std::get_if<TriangleMesh const*>(&view.body->shape);
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) {
      continue;
    }
    std::size_t const lane = RTCRayN_id(rays, arguments->N, i);
    Eigen::Vector3d const ray = view.R_thing_camera * packet.rays_camera[lane];
    std::optional<RayEntry> const entry =
        mesh != nullptr ? enter_triangle(**mesh, arguments->primID, view.eye_thing, ray)
                        : enter(std::get<Solid>(view.body->shape), view.eye_thing, ray);
    if (!entry.has_value()) {
      continue;
    }
    Hit const hit{*entry, arguments->geomID, arguments->primID};
    if (hit.before(packet.hits[lane])) {
      packet.hits[lane] = hit;
      RTCRayN_tfar(rays, arguments->N, i) = static_cast<float>(entry->distance);
    }
  }
}

/// Some light from everywhere, some from a far lamp overhead, some from the camera (Lambert), so
/// that every edge shows.
Rgb shade(Body const& body, RayEntry const& entry, Eigen::Vector3d const& p_thing,
          double camera_cosine) {
  double const lamp_cosine = std::max(0.0, entry.normal.dot(body.to_lamp_thing));
  auto light = static_cast<float>(0.42 + 0.3 * lamp_cosine + 0.28 * camera_cosine);
  light *= static_cast<float>(texture_shade(body.texture, body.texture_seed, p_thing));
  Eigen::Vector3f const lit = (body.color * light).cwiseMin(255.0F);
  return {static_cast<std::uint8_t>(lit.x()), static_cast<std::uint8_t>(lit.y()),
          static_cast<std::uint8_t>(lit.z())};
}

}  // namespace

struct RayCaster::World {
  SceneCamera camera;
  PresentThings things;
  std::vector<Body> bodies;
  Device device;
  BodyTree tree;

  World(Scene const& scene, double time_s);
  void add(std::size_t thing);
  /// Sends rays through at most kLanes pixels.
  void shoot(Gaze const& gaze, std::span<Pixel const> pixels, RayPacket& packet) const;
  void render_row(Gaze const& gaze, int v, RenderedView& view) const;
  void take_hit(RayPacket const& packet, std::size_t lane, Pixel pixel, RenderedView& view) const;
};

RayCaster::World::World(Scene const& scene, double time_s)
    : camera(scene.camera),
      things(things_at(scene, time_s)),
      device(rtcNewDevice(nullptr)),
      tree(rtcNewScene(device.get())) {
  if (tree == nullptr) {
    throw std::runtime_error("Embree does not start on this machine");
  }
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].has_value()) {
      add(i);
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    auto const* mesh = std::get_if<TriangleMesh const*>(&bodies[i].shape);
    RTCGeometry body = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(
        body, mesh != nullptr ? static_cast<unsigned>((*mesh)->triangles.size()) : 1U);
    rtcSetGeometryUserData(body, &bodies[i]);
    rtcSetGeometryBoundsFunction(body, bound_body, nullptr);
    rtcSetGeometryIntersectFunction(body, intersect_body);
    rtcCommitGeometry(body);
    rtcAttachGeometryByID(tree.get(), body, static_cast<unsigned>(i));
    rtcReleaseGeometry(body);
  }
  rtcCommitScene(tree.get());
}

void RayCaster::World::add(std::size_t thing) {
  SceneThing const& one = things[thing].value();
  Se3 const T_world_thing = pose_of(one);
  Eigen::Vector3d const to_lamp_world = Eigen::Vector3d(-0.35, -0.25, 0.9).normalized();
  Body body{{},
            thing,
            T_world_thing,
            T_world_thing.rotation().conjugate() * to_lamp_world,
            Eigen::Vector3d(one.color[0], one.color[1], one.color[2]).cast<float>(),
            texture_of(one),
            texture_seed(one.name)};
  if (TriangleMesh const* mesh = mesh_of(one); mesh != nullptr) {
    body.shape = mesh;
    bodies.push_back(body);
  }
  for (Solid const& solid : solids_of(one)) {
    body.shape = solid;
    bodies.push_back(body);
  }
}

void RayCaster::World::take_hit(RayPacket const& packet, std::size_t lane, Pixel pixel,
                                RenderedView& view) const {
  BodyView const& body_view = packet.gaze->views[packet.hits[lane].body];
  RayEntry const& entry = packet.hits[lane].entry;
  view.thing[pixel] = static_cast<std::int32_t>(body_view.body->thing);
  if (entry.distance >= camera.min_range_m && entry.distance <= camera.max_range_m) {
    view.depth_m[pixel] = static_cast<float>(entry.distance);
  }
  Eigen::Vector3d const ray_thing = body_view.R_thing_camera * packet.rays_camera[lane];
  double const camera_cosine = std::abs(entry.normal.dot(ray_thing)) / ray_thing.norm();
  view.incidence_cosine[pixel] = static_cast<float>(camera_cosine);
  view.color[pixel] = shade(*body_view.body, entry,
                            body_view.eye_thing + entry.distance * ray_thing, camera_cosine);
}

void RayCaster::World::shoot(Gaze const& gaze, std::span<Pixel const> pixels,
                             RayPacket& packet) const {
  rtcInitIntersectContext(&packet.context);
  packet.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  packet.gaze = &gaze;
  RTCRayHit8 rays{};
  alignas(32) std::array<int, kLanes> valid{};  // Embree loads it whole
  for (std::size_t lane = 0; lane < pixels.size(); ++lane) {
    valid[lane] = -1;
    packet.rays_camera[lane] = {(pixels[lane].u - camera.cx_px) / camera.fx_px,
                                (pixels[lane].v - camera.cy_px) / camera.fy_px, 1.0};
    packet.hits[lane] = Hit{};
    Eigen::Vector3f const ray = (gaze.R_world_camera * packet.rays_camera[lane]).cast<float>();
    rays.ray.org_x[lane] = gaze.eye_world.x();
    rays.ray.org_y[lane] = gaze.eye_world.y();
    rays.ray.org_z[lane] = gaze.eye_world.z();
    rays.ray.dir_x[lane] = ray.x();
    rays.ray.dir_y[lane] = ray.y();
    rays.ray.dir_z[lane] = ray.z();
    rays.ray.tfar[lane] = std::numeric_limits<float>::infinity();
    rays.ray.mask[lane] = ~0U;
    rays.ray.id[lane] = static_cast<unsigned>(lane);
    rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect8(valid.data(), tree.get(), &packet.context, &rays);
}

void RayCaster::World::render_row(Gaze const& gaze, int v, RenderedView& view) const {
  RayPacket packet;
  std::array<Pixel, kLanes> pixels;
  for (int first = 0; first < camera.width_px; first += kLanes) {
    auto const count = static_cast<std::size_t>(std::min(kLanes, camera.width_px - first));
    for (std::size_t lane = 0; lane < count; ++lane) {
      pixels[lane] = {first + static_cast<int>(lane), v};
    }
    shoot(gaze, std::span(pixels).first(count), packet);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (packet.hits[lane].body != RTC_INVALID_GEOMETRY_ID) {
        take_hit(packet, lane, pixels[lane], view);
      }
    }
  }
}

RayCaster::RayCaster(Scene const& scene, double time_s) {
  check_scene(scene);
  world_ = std::make_unique<World>(scene, time_s);
}

RayCaster::~RayCaster() = default;

SceneCamera const& RayCaster::camera() const {
  return world_->camera;
}

PresentThings const& RayCaster::things() const {
  return world_->things;
}

RenderedView RayCaster::render(Se3 const& T_world_camera) const {
  int const width = world_->camera.width_px;
  int const height = world_->camera.height_px;
  RenderedView view{Grid<float>(width, height), Grid<Rgb>(width, height, kNothing),
                    Grid<std::int32_t>(width, height, -1), Grid<float>(width, height)};
  Gaze const gaze(world_->bodies, T_world_camera);
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](auto const& rows) {
    for (int v = rows.begin(); v < rows.end(); ++v) {
      world_->render_row(gaze, v, view);
    }
  });
  return view;
}

std::vector<PixelHit> RayCaster::look(Se3 const& T_world_camera, std::vector<Pixel> const& pixels,
                                      std::optional<std::size_t> only) const {
  Gaze const gaze(world_->bodies, T_world_camera, only);
  RayPacket packet;
  std::vector<PixelHit> seen;
  seen.reserve(pixels.size());
  for (std::size_t first = 0; first < pixels.size(); first += kLanes) {
    std::size_t const count = std::min<std::size_t>(kLanes, pixels.size() - first);
    world_->shoot(gaze, std::span(pixels).subspan(first, count), packet);
    for (std::size_t lane = 0; lane < count; ++lane) {
      Hit const& hit = packet.hits[lane];
      seen.push_back(hit.body != RTC_INVALID_GEOMETRY_ID
                         ? PixelHit{gaze.views[hit.body].body->thing, hit.entry.distance}
                         : PixelHit{});
    }
  }
  return seen;
}

}  // namespace credo
