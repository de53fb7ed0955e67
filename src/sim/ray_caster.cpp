#include "sim/ray_caster.hpp"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"

namespace credo {
namespace {

constexpr int kLanes = 8;
constexpr int kCylinderSides = 96;

struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<unsigned, 3>> triangles;

  void add_triangle(unsigned a, unsigned b, unsigned c) { triangles.push_back({a, b, c}); }
};

/// A box from `low` to `high`.
void add_box(Mesh& mesh, Eigen::Vector3d const& low, Eigen::Vector3d const& high) {
  auto const base = static_cast<unsigned>(mesh.vertices.size());
  for (unsigned corner = 0; corner < 8; ++corner) {
    mesh.vertices.push_back(Eigen::Vector3d((corner & 1U) != 0 ? high.x() : low.x(),
                                            (corner & 2U) != 0 ? high.y() : low.y(),
                                            (corner & 4U) != 0 ? high.z() : low.z())
                                .cast<float>());
  }
  constexpr std::array<std::array<unsigned, 4>, 6> kFaces = {
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (auto const& f : kFaces) {
    mesh.add_triangle(base + f[0], base + f[1], base + f[2]);
    mesh.add_triangle(base + f[0], base + f[2], base + f[3]);
  }
}

void add_cylinder(Mesh& mesh, double radius_m, double height_m) {
  for (double const z : {0.0, height_m}) {
    mesh.vertices.push_back(Eigen::Vector3d(0, 0, z).cast<float>());
    for (int k = 0; k < kCylinderSides; ++k) {
      double const angle = 2.0 * std::numbers::pi * k / kCylinderSides;
      mesh.vertices.push_back(
          Eigen::Vector3d(radius_m * std::cos(angle), radius_m * std::sin(angle), z).cast<float>());
    }
  }
  constexpr unsigned kTop = kCylinderSides + 1;
  for (unsigned k = 0; k < kCylinderSides; ++k) {
    unsigned const a = 1 + k;
    unsigned const b = 1 + (k + 1) % kCylinderSides;
    mesh.add_triangle(0, a, b);
    mesh.add_triangle(kTop, kTop + a, kTop + b);
    mesh.add_triangle(a, b, kTop + b);
    mesh.add_triangle(a, kTop + b, kTop + a);
  }
}

void add_table(Mesh& mesh, std::vector<double> const& size_m) {
  double const x = 0.5 * size_m[0];
  double const y = 0.5 * size_m[1];
  double const height = size_m[2];
  double const thickness = size_m[3];
  double const leg = size_m[4];
  add_box(mesh, {-x, -y, height - thickness}, {x, y, height});
  for (double const lx : {-x, x - leg}) {
    for (double const ly : {-y, y - leg}) {
      add_box(mesh, {lx, ly, 0}, {lx + leg, ly + leg, height - thickness});
    }
  }
}

Mesh mesh_of(SceneThing const& thing) {
  Mesh mesh;
  std::vector<double> const& s = thing.size_m;
  if (thing.shape == SceneShape::kBox) {
    add_box(mesh, {-0.5 * s[0], -0.5 * s[1], 0}, {0.5 * s[0], 0.5 * s[1], s[2]});
  } else if (thing.shape == SceneShape::kCylinder) {
    add_cylinder(mesh, s[0], s[1]);
  } else {
    add_table(mesh, s);
  }
  return mesh;
}

Se3 pose_of(SceneThing const& thing) {
  Eigen::Vector3d const turn =
      Eigen::Vector3d(thing.rpy_deg[0], thing.rpy_deg[1], thing.rpy_deg[2]) *
      (std::numbers::pi / 180.0);
  Eigen::Quaterniond const rotation =
      so3_exp({0, 0, turn.z()}) * so3_exp({0, turn.y(), 0}) * so3_exp({turn.x(), 0, 0});
  return {rotation, {thing.position_m[0], thing.position_m[1], thing.position_m[2]}};
}

RTCGeometry triangle_geometry(RTCDevice device, Mesh const& mesh, Se3 const& T_world_thing) {
  RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    Eigen::Vector3f const v = (T_world_thing * mesh.vertices[i].cast<double>()).cast<float>();
    std::copy_n(v.data(), 3, vertices + 3 * i);
  }
  auto* triangles = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::copy_n(mesh.triangles[i].data(), 3, triangles + 3 * i);
  }
  return geometry;
}

RTCGeometry sphere_geometry(RTCDevice device, double radius_m, Se3 const& T_world_thing) {
  RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* sphere = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
  Eigen::Vector3f const centre = (T_world_thing * Eigen::Vector3d(0, 0, radius_m)).cast<float>();
  std::copy_n(centre.data(), 3, sphere);
  sphere[3] = static_cast<float>(radius_m);
  return geometry;
}

/// Lambert's law under a lamp at the camera and some light from everywhere; a checkerboard lies in
/// the thing's own axes.
Rgb shade(SceneThing const& thing, Eigen::Vector3f const& p_thing, float cosine) {
  float light = 0.35F + 0.65F * cosine;
  if (thing.checker_m > 0) {
    auto const cell = static_cast<float>(thing.checker_m);
    // Half a micrometre keeps faces that lie on a cell's border in one cell.
    Eigen::Vector3f const q = (p_thing.array() / cell + 1e-4F).floor();
    light *= (static_cast<long>(q.sum()) & 1L) != 0 ? 0.72F : 1.0F;
  }
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] = static_cast<std::uint8_t>(
        std::clamp(static_cast<float>(thing.color[c]) * light, 0.0F, 255.0F));
  }
  return color;
}

}  // namespace

struct RayCaster::World {
  Scene scene;
  std::vector<Se3> T_thing_world;
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene geometry = rtcNewScene(device);

  explicit World(Scene const& description) : scene(description) {
    for (SceneThing const& thing : scene.things) {
      Se3 const pose = pose_of(thing);
      T_thing_world.push_back(pose.inverse());
      RTCGeometry const part = thing.shape == SceneShape::kSphere
                                   ? sphere_geometry(device, thing.size_m[0], pose)
                                   : triangle_geometry(device, mesh_of(thing), pose);
      rtcCommitGeometry(part);
      // Geometries are numbered in this order: the number is the thing's position.
      rtcAttachGeometry(geometry, part);
      rtcReleaseGeometry(part);
    }
    rtcCommitScene(geometry);
  }
  World(World const&) = delete;
  World& operator=(World const&) = delete;
  World(World&&) = delete;
  World& operator=(World&&) = delete;
  ~World() {
    rtcReleaseScene(geometry);
    rtcReleaseDevice(device);
  }

  void render_row(Se3 const& T_world_camera, int v, RenderedView& view) const;
  void take_hit(RTCRayHit8 const& rays, int lane, Eigen::Vector3f const& direction_world,
                Pixel pixel, RenderedView& view) const;
};

void RayCaster::World::take_hit(RTCRayHit8 const& rays, int lane,
                                Eigen::Vector3f const& direction_world, Pixel pixel,
                                RenderedView& view) const {
  unsigned const id = rays.hit.geomID[lane];
  if (id == RTC_INVALID_GEOMETRY_ID) {
    return;
  }
  view.thing[pixel] = static_cast<std::int32_t>(id);
  // The ray's direction has length 1 along the optical axis, so its parameter is the depth.
  float const depth_m = rays.ray.tfar[lane];
  if (static_cast<double>(depth_m) >= scene.camera.min_range_m &&
      static_cast<double>(depth_m) <= scene.camera.max_range_m) {
    view.depth_m[pixel] = depth_m;
  }
  Eigen::Vector3f const normal(rays.hit.Ng_x[lane], rays.hit.Ng_y[lane], rays.hit.Ng_z[lane]);
  float const cosine = std::abs(normal.normalized().dot(direction_world.normalized()));
  Eigen::Vector3f const origin(rays.ray.org_x[lane], rays.ray.org_y[lane], rays.ray.org_z[lane]);
  Eigen::Vector3d const p_world = (origin + depth_m * direction_world).cast<double>();
  view.color[pixel] = shade(scene.things[id], (T_thing_world[id] * p_world).cast<float>(), cosine);
}

void RayCaster::World::render_row(Se3 const& T_world_camera, int v, RenderedView& view) const {
  SceneCamera const& camera = scene.camera;
  Eigen::Matrix3d const R = T_world_camera.rotation().toRotationMatrix();
  Eigen::Vector3f const origin = T_world_camera.translation().cast<float>();
  for (int first = 0; first < camera.width_px; first += kLanes) {
    RTCRayHit8 rays{};
    alignas(32) std::array<int, kLanes> valid{};  // Embree loads it whole
    std::array<Eigen::Vector3f, kLanes> directions;
    for (int lane = 0; lane < kLanes; ++lane) {
      int const u = first + lane;
      valid[static_cast<std::size_t>(lane)] = u < camera.width_px ? -1 : 0;
      Eigen::Vector3f const d = (R * Eigen::Vector3d((u - camera.cx_px) / camera.fx_px,
                                                     (v - camera.cy_px) / camera.fy_px, 1.0))
                                    .cast<float>();
      directions[static_cast<std::size_t>(lane)] = d;
      rays.ray.org_x[lane] = origin.x();
      rays.ray.org_y[lane] = origin.y();
      rays.ray.org_z[lane] = origin.z();
      rays.ray.dir_x[lane] = d.x();
      rays.ray.dir_y[lane] = d.y();
      rays.ray.dir_z[lane] = d.z();
      rays.ray.tnear[lane] = 1e-3F;
      rays.ray.tfar[lane] = 1e6F;
      rays.ray.mask[lane] = ~0U;
      rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid.data(), geometry, &context, &rays);
    for (int lane = 0; lane < std::min(kLanes, camera.width_px - first); ++lane) {
      take_hit(rays, lane, directions[static_cast<std::size_t>(lane)], {first + lane, v}, view);
    }
  }
}

RayCaster::RayCaster(Scene const& scene) {
  check_scene(scene);
  world_ = std::make_unique<World>(scene);
}

RayCaster::~RayCaster() = default;

RenderedView RayCaster::render(Se3 const& T_world_camera) const {
  SceneCamera const& camera = world_->scene.camera;
  RenderedView view{Grid<float>(camera.width_px, camera.height_px),
                    Grid<Rgb>(camera.width_px, camera.height_px, Rgb{20, 20, 24}),
                    Grid<std::int32_t>(camera.width_px, camera.height_px, -1)};
  tbb::parallel_for(0, camera.height_px,
                    [&](int v) { world_->render_row(T_world_camera, v, view); });
  return view;
}

}  // namespace credo
