#include "detector/models/model_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "detector/poses/camera_pose.hpp"
#include "geometry/depth_patch.hpp"
#include "io/palette.hpp"

namespace credo {
namespace {

constexpr int kPanel_px = 320;
constexpr Rgb kOutside = {235, 235, 230};
constexpr Rgb kInside = {150, 45, 40};
/// A camera so far away, in radii of the mesh, that it sees nearly in parallel.
constexpr float kDistance_radii = 8.0F;

struct Side {
  Eigen::Vector3f to_camera;
  Eigen::Vector3f up;
};

std::array<Side, 6> sides() {
  Eigen::Vector3f const x = Eigen::Vector3f::UnitX();
  Eigen::Vector3f const y = Eigen::Vector3f::UnitY();
  Eigen::Vector3f const z = Eigen::Vector3f::UnitZ();
  return {Side{x, z}, {y, z}, {z, y}, {-x, z}, {-y, z}, {-z, y}};
}

struct Sphere {
  Eigen::Vector3f centre;
  float radius_m = 0.0F;
};

Sphere around(TriangleMesh const& mesh) {
  Eigen::AlignedBox3f bounds;
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    bounds.extend(vertex);
  }
  Sphere sphere{bounds.center()};
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    sphere.radius_m = std::max(sphere.radius_m, (vertex - sphere.centre).norm());
  }
  return sphere;
}

/// The depth of all of a panel.
Grid<float> depth_of(DepthPatch const& patch) {
  Grid<float> depth_m(kPanel_px, kPanel_px, kNoSurface_m);
  for (int v = 0; v < patch.depth_m.height(); ++v) {
    std::ranges::copy(patch.depth_m.row(v),
                      depth_m.row(v + patch.corner.v).begin() + patch.corner.u);
  }
  return depth_m;
}

/// Of the angle between a surface and the viewer, from the depths of pixels side by side.
float facing(Grid<float> const& depth_m, Pixel at, float pixel_m) {
  auto const slope = [&](Pixel before, Pixel after) {
    bool const both = depth_m.contains(before) && depth_m.contains(after) &&
                      depth_m[before] < kNoSurface_m && depth_m[after] < kNoSurface_m;
    return both ? (depth_m[after] - depth_m[before]) / (2.0F * pixel_m) : 0.0F;
  };
  float const across = slope({at.u - 1, at.v}, {at.u + 1, at.v});
  float const down = slope({at.u, at.v - 1}, {at.u, at.v + 1});
  return 1.0F / std::sqrt(1.0F + across * across + down * down);
}

void draw(TriangleMesh const& mesh, Sphere const& sphere, Side const& side, Pixel corner,
          Grid<Rgb>& picture) {
  CameraPose pose;
  pose.rotation << side.up.cross(side.to_camera).transpose(), -side.up.transpose(),
      -side.to_camera.transpose();
  float const distance_m = kDistance_radii * sphere.radius_m;
  pose.translation_m = Eigen::Vector3f(0, 0, distance_m) - pose.rotation * sphere.centre;
  auto const focal_px = 0.47 * kPanel_px * static_cast<double>(kDistance_radii);
  CameraIntrinsics const intrinsics{focal_px, focal_px, kPanel_px / 2.0, kPanel_px / 2.0};
  std::vector<Eigen::Vector3f> vertices;
  vertices.reserve(mesh.vertices.size());
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    vertices.push_back(pose * vertex);
  }
  ImageSize const size{kPanel_px, kPanel_px};
  Grid<float> const all_m = depth_of(render_depth(vertices, mesh.triangles, intrinsics, size));
  Grid<float> const outside_m =
      depth_of(render_depth(vertices, facing_camera(vertices, mesh.triangles), intrinsics, size));
  float const pixel_m = distance_m / static_cast<float>(focal_px);
  for (int v = 0; v < kPanel_px; ++v) {
    for (int u = 0; u < kPanel_px; ++u) {
      if (all_m[{u, v}] == kNoSurface_m) {
        continue;
      }
      bool const inside = all_m[{u, v}] < outside_m[{u, v}];
      auto const light = static_cast<double>(facing(all_m, {u, v}, pixel_m));
      picture[Pixel{corner.u + u, corner.v + v}] =
          mixed(kBackground, inside ? kInside : kOutside, 0.25 + 0.75 * light);
    }
  }
}

}  // namespace

Grid<Rgb> draw_model(TriangleMesh const& mesh) {
  if (mesh.triangles.empty()) {
    return {};
  }
  Grid<Rgb> picture(3 * kPanel_px, 2 * kPanel_px, kBackground);
  Sphere const sphere = around(mesh);
  Pixel corner{0, 0};
  for (Side const& side : sides()) {
    draw(mesh, sphere, side, corner, picture);
    corner.u += kPanel_px;
    if (corner.u == picture.width()) {
      corner = {0, kPanel_px};
    }
  }
  return picture;
}

}  // namespace credo
