#include "support/rendered_scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>

namespace credo::test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where a ray from the camera, z = 1 a unit of depth, first meets something.
struct Hit {
  double depth_m = kNever;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

void meet(Plane const& plane, Eigen::Vector3d const& ray, Hit& hit) {
  double const slope = plane.normal.dot(ray);
  double const depth = plane.offset_m / slope;
  if (slope < 0.0 && depth > 0.0 && depth < hit.depth_m) {
    hit = {depth, plane.normal};
  }
}

void meet(Convex const& body, Eigen::Vector3d const& ray, Hit& hit) {
  Hit entry{0.0, Eigen::Vector3d::Zero()};
  double exit = kNever;
  for (Plane const& plane : body) {
    double const slope = plane.normal.dot(ray);
    double const depth = plane.offset_m / slope;
    if (slope < 0.0 && depth > entry.depth_m) {
      entry = {depth, plane.normal};
    } else if (slope > 0.0) {
      exit = std::min(exit, depth);
    } else if (slope == 0.0 && plane.offset_m < 0.0) {
      return;
    }
  }
  if (entry.depth_m > 0.0 && entry.depth_m < exit && entry.depth_m < hit.depth_m) {
    hit = entry;
  }
}

void meet(Sphere const& sphere, Eigen::Vector3d const& ray, Hit& hit) {
  double const a = ray.squaredNorm();
  double const b = ray.dot(sphere.centre_m);
  double const c = sphere.centre_m.squaredNorm() - sphere.radius_m * sphere.radius_m;
  double const discriminant = b * b - a * c;
  if (discriminant < 0.0) {
    return;
  }
  double const depth = (b - std::sqrt(discriminant)) / a;
  if (depth > 0.0 && depth < hit.depth_m) {
    hit = {depth, (depth * ray - sphere.centre_m).normalized()};
  }
}

// Disparity of 1/8 px steps: baseline 7.5 cm, focal length 585 px.
constexpr double kDisparityPx = 0.075 * 585.0;

/// Whether the projector, 7.5 cm to the right of the camera, sees what a pixel sees: in the
/// projector's image its column is u - disparity, and the nearest surface of a column is lit.
Grid<std::uint8_t> lit_by_projector(Grid<float> const& depth_m) {
  Grid<std::uint8_t> lit(depth_m.width(), depth_m.height(), 0);
  for (int v = 0; v < depth_m.height(); ++v) {
    // From right to left, a surface is hidden where something further right already reaches past
    // its column.
    double reached = kNever;
    for (int u = depth_m.width() - 1; u >= 0; --u) {
      Pixel const p{u, v};
      if (depth_m[p] > 0.0F) {
        double const column = u - kDisparityPx / depth_m[p];
        lit[p] = column < reached ? 1 : 0;
        reached = std::min(reached, column);
      }
    }
  }
  return lit;
}

}  // namespace

Convex box(Eigen::Vector3d const& centre_m, Eigen::Matrix3d const& axes,
           Eigen::Vector3d const& half_size_m) {
  Convex faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (double const sign : {-1.0, 1.0}) {
      Eigen::Vector3d const normal = sign * axes.col(axis);
      faces.push_back({normal, normal.dot(centre_m) + half_size_m[axis]});
    }
  }
  return faces;
}

Rendering render(Scene const& scene, int width, int height, CameraIntrinsics const& intrinsics) {
  Rendering result{Grid<float>(width, height, 0.0F), NormalMap(width, height)};
  for (std::size_t i = 0; i < result.depth_m.size(); ++i) {
    Pixel const p = result.depth_m.pixel(i);
    Eigen::Vector3d const ray((p.u - intrinsics.cx_px) / intrinsics.fx_px,
                              (p.v - intrinsics.cy_px) / intrinsics.fy_px, 1.0);
    Hit hit;
    auto const meet_all = [&](auto const& things) {
      for (auto const& thing : things) {
        meet(thing, ray, hit);
      }
    };
    meet_all(scene.planes);
    meet_all(scene.bodies);
    meet_all(scene.spheres);
    if (hit.depth_m < kNever) {
      result.depth_m[i] = static_cast<float>(hit.depth_m);
      result.normals.set(i, hit.normal.cast<float>());
    }
  }
  return result;
}

Grid<float> with_kinect_noise(Grid<float> const& depth_m, unsigned seed) {
  constexpr double kSteps = 8.0 * kDisparityPx;
  std::mt19937 random(seed);
  std::normal_distribution<double> aside_px(0.0, 0.5);
  std::normal_distribution<double> scatter(0.0, 1.0 / 6.0);
  Grid<std::uint8_t> const lit = lit_by_projector(depth_m);
  Grid<float> noisy(depth_m.width(), depth_m.height(), 0.0F);
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      auto const clamped = [](double x, int size) {
        return std::clamp(static_cast<int>(std::lround(x)), 0, size - 1);
      };
      Pixel const seen{clamped(u + aside_px(random), depth_m.width()),
                       clamped(v + aside_px(random), depth_m.height())};
      double const steps = std::floor(kSteps / depth_m[seen] + scatter(random) + 0.5);
      if (lit[seen] != 0 && steps > 0.0) {
        noisy[Pixel{u, v}] = static_cast<float>(kSteps / steps);
      }
    }
  }
  return noisy;
}

CameraIntrinsics kinect_intrinsics() {
  return {585.0, 585.0, 319.5, 239.5};
}

Scene room_scene() {
  using Eigen::AngleAxisd;
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  // Down 30 degrees: axes of the room (right, down, ahead) in the camera frame.
  Matrix3d const room = AngleAxisd(0.52, Vector3d::UnitX()).toRotationMatrix();
  auto const place = [&](double right, double height, double ahead) -> Vector3d {
    return room * Vector3d(right, 1.2 - height, ahead);
  };
  auto const upright = [&](double yaw) -> Matrix3d {
    return room * AngleAxisd(yaw, Vector3d::UnitY()).toRotationMatrix();
  };
  auto const plane = [&](Vector3d const& normal, Vector3d const& through) {
    Vector3d const n = room * normal;
    return Plane{n, n.dot(through)};
  };
  Scene scene;
  scene.planes = {plane({0, -1, 0}, place(0, 0, 0)),
                  plane(Vector3d(0.3, 0, -1).normalized(), place(0, 0, 3.2)),
                  plane(Vector3d(-1, 0, -0.3).normalized(), place(1.3, 0, 2))};
  scene.bodies = {box(place(-0.1, 0.7, 1.4), upright(0.3), {0.45, 0.02, 0.3}),
                  box(place(-0.3, 0.80, 1.3), upright(-0.4), {0.06, 0.08, 0.04}),
                  box(place(0.1, 0.77, 1.45), upright(0.8), {0.10, 0.05, 0.06}),
                  box(place(0.25, 0.73, 1.2), upright(0.2), {0.03, 0.01, 0.08}),
                  box(place(0.7, 0.25, 2.2), upright(0.5), {0.2, 0.25, 0.2}),
                  box(place(-0.45, 0.35, 1.25), upright(0.3), {0.02, 0.35, 0.02}),
                  box(place(0.02, 0.85, 0.75), upright(0.1), {0.05, 0.03, 0.05})};
  scene.spheres = {{place(-0.05, 0.78, 1.25), 0.06}, {place(-0.7, 0.15, 2.0), 0.15}};
  return scene;
}

}  // namespace credo::test
