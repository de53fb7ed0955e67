// Depth against what the equations of plane, sphere and cylinder give for each pixel.
#include "sim/ray_caster.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <optional>

#include "core/error.hpp"
#include "sim/camera_path.hpp"
#include "sim/scenes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

/// Depths are floats, and follow from the same numbers in doubles.
constexpr double kToleranceM = 1e-6;

Se3 resting_pose(Scene const& scene) {
  return camera_pose(scene.camera.path, 0.0);
}

RenderedView render(Scene const& scene) {
  return RayCaster(scene).render(resting_pose(scene));
}

/// The ray through a pixel in the world, one unit long along the optical axis.
Vector3d ray_of(Scene const& scene, Pixel p) {
  SceneCamera const& camera = scene.camera;
  Vector3d const ray((p.u - camera.cx_px) / camera.fx_px, (p.v - camera.cy_px) / camera.fy_px, 1);
  return resting_pose(scene).rotation() * ray;
}

/// Every pixel's depth is what `expected` says for its ray; none = nothing there.
void expect_depth(Scene const& scene,
                  std::function<std::optional<double>(Vector3d const&)> const& expected) {
  RenderedView const view = render(scene);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < view.depth_m.size(); ++i) {
    Pixel const p = view.depth_m.pixel(i);
    std::optional<double> const depth = expected(ray_of(scene, p));
    bool const measured = depth.has_value() && *depth <= scene.camera.max_range_m;
    ASSERT_NEAR(view.depth_m[i], measured ? *depth : 0.0, kToleranceM) << p.u << ", " << p.v;
    ASSERT_EQ(view.thing[i], depth.has_value() ? 0 : -1) << p.u << ", " << p.v;
    hits += measured ? 1 : 0;
  }
  EXPECT_GT(hits, view.depth_m.size() / 20);
  EXPECT_LT(hits, view.depth_m.size());
}

TEST(RayCaster, SeesAFloorInPerspective) {
  Scene const scene = small_scene({thing("floor", SceneShape::kBox, {1000, 1000, 1}, {0, 0, -1})});
  expect_depth(scene, [&](Vector3d const& ray) -> std::optional<double> {
    // From 1 m above.
    return ray.z() < 0 ? std::optional(-1.0 / ray.z()) : std::nullopt;
  });
}

TEST(RayCaster, SeesASphere) {
  double const r = 0.8;
  Vector3d const center(3, 0.2, 1.1);
  Scene const scene = small_scene(
      {thing("ball", SceneShape::kSphere, {r}, {center.x(), center.y(), center.z() - r})});
  expect_depth(scene, [&](Vector3d const& ray) -> std::optional<double> {
    Vector3d const to_eye = Vector3d(0, 0, 1) - center;
    double const a = ray.squaredNorm();
    double const b = ray.dot(to_eye);
    double const c = to_eye.squaredNorm() - r * r;
    double const root = b * b - a * c;
    return root > 0 ? std::optional((-b - std::sqrt(root)) / a) : std::nullopt;
  });
}

TEST(RayCaster, SeesTheSideOfACylinder) {
  double const r = 0.6;
  Scene const scene = small_scene({thing("post", SceneShape::kCylinder, {r, 500}, {2, 0.1, -100})});
  expect_depth(scene, [&](Vector3d const& ray) -> std::optional<double> {
    double const a = ray.head<2>().squaredNorm();
    double const b = -2 * ray.x() - 0.1 * ray.y();
    double const c = 4 + 0.01 - r * r;
    double const root = b * b - a * c;
    return root > 0 ? std::optional((-b - std::sqrt(root)) / a) : std::nullopt;
  });
}

TEST(RayCaster, SeesATurnedBoxOnItsNearFaces) {
  SceneThing box = thing("box", SceneShape::kBox, {1, 1, 4}, {3, 0, -1});
  box.rpy_deg = {0, 0, 45};
  Scene const scene = small_scene({box});
  // An edge points at the camera: the faces are |x - 3| + |y| = sqrt(1/2).
  double const half = std::sqrt(0.5);
  expect_depth(scene, [&](Vector3d const& ray) -> std::optional<double> {
    double const slope = std::abs(ray.y() / ray.x());
    double const x = (3 - half) / (1 - slope);
    return x * slope < half && slope < 1 ? std::optional(x / ray.x()) : std::nullopt;
  });
}

TEST(RayCaster, TheNearestThingIsSeenAndNamed) {
  Scene const scene = small_scene({thing("wall", SceneShape::kBox, {0.1, 9, 9}, {5.05, 0, -4}),
                                   thing("ball", SceneShape::kSphere, {0.5}, {3, 0, 0.5})});
  RenderedView const view = render(scene);
  EXPECT_EQ((view.thing[Pixel{0, 0}]), 0);
  EXPECT_NEAR((view.depth_m[Pixel{0, 0}]), 5.0, kToleranceM);
  EXPECT_EQ((view.thing[Pixel{32, 24}]), 1);
  EXPECT_NEAR((view.depth_m[Pixel{32, 24}]), 2.5, 1e-3);
}

TEST(RayCaster, WhatIsOutOfRangeIsSeenButNotMeasured) {
  for (double const x : {0.3, 8.5}) {
    Scene const scene =
        small_scene({thing("wall", SceneShape::kBox, {1, 99, 99}, {x + 0.5, 0, -50})});
    RenderedView const view = render(scene);
    EXPECT_EQ((view.thing[Pixel{5, 5}]), 0);
    EXPECT_EQ((view.depth_m[Pixel{5, 5}]), 0.0F);
  }
}

TEST(RayCaster, ColoursAreLitShadesOfTheThing) {
  SceneThing wall = thing("wall", SceneShape::kBox, {1, 99, 99}, {3.5, 0, -50});
  wall.color = {200, 100, 0};
  RenderedView const plain = render(small_scene({wall}));
  Rgb const shade = plain.color[Pixel{32, 24}];
  EXPECT_NEAR(shade[0], 2 * shade[1], 2);
  EXPECT_GT(shade[0], 80);
  EXPECT_EQ(shade[2], 0);
  wall.checker_m = 0.5;
  RenderedView const checkered = render(small_scene({wall}));
  int darker = 0;
  for (std::size_t i = 0; i < plain.color.size(); ++i) {
    darker += checkered.color[i][0] < plain.color[i][0] ? 1 : 0;
  }
  EXPECT_NEAR(darker, 64 * 48 / 2, 64 * 48 / 6);
}

TEST(RayCaster, IsTheSameAtAnyNumberOfThreads) {
  Scene scene =
      small_scene({thing("floor", SceneShape::kBox, {9, 9, 0.05}, {0, 0, -0.05}),
                   thing("table", SceneShape::kTable, {0.8, 1.2, 0.7, 0.04, 0.06}, {2, 0, 0}),
                   thing("twin", SceneShape::kTable, {0.8, 1.2, 0.7, 0.04, 0.06}, {2, 0, 0})});
  scene.camera.width_px = 203;
  scene.camera.height_px = 151;
  RayCaster const caster(scene);
  RenderedView const many = caster.render(resting_pose(scene));
  tbb::global_control const one(tbb::global_control::max_allowed_parallelism, 1);
  RenderedView const alone = caster.render(resting_pose(scene));
  for (std::size_t i = 0; i < many.depth_m.size(); ++i) {
    ASSERT_EQ(many.depth_m[i], alone.depth_m[i]);
    ASSERT_EQ(many.color[i], alone.color[i]);
    ASSERT_NE(many.thing[i], 2) << "of two in one place the first is seen";
  }
}

TEST(RayCaster, RefusesWhatIsNoScene) {
  EXPECT_THROW(RayCaster(small_scene({})), InputError);
}

}  // namespace
}  // namespace credo::test
