// Things that look like a mesh, against trying every triangle with every ray.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "sim/camera_path.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scenes.hpp"
#include "sim/thing.hpp"
#include "sim/truth.hpp"
#include "sim/visibility.hpp"
#include "support/meshes.hpp"
#include "support/temp_folder.hpp"
#include "tools/scene_file.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

constexpr double kToleranceM = 1e-6;

SceneThing mesh_thing(std::string name, TriangleMesh mesh, std::vector<double> position_m) {
  SceneThing result = thing(std::move(name), SceneShape::kBox, {}, std::move(position_m));
  result.model = "made here";
  result.loaded_model = std::make_shared<ObjectModel const>(
      ObjectModel{"ring", std::variant<std::vector<Solid>, TriangleMesh>(std::move(mesh)), {}});
  return result;
}

/// A ring before the camera, turned about all axes.
SceneThing ring(std::vector<double> position_m = {0.9, 0.05, 1.0}) {
  SceneThing result = mesh_thing("ring", wavy_ring(24, 12), std::move(position_m));
  result.rpy_deg = {70, 25, 40};
  return result;
}

Se3 resting_pose(Scene const& scene) {
  return camera_pose(scene.camera.path, 0.0);
}

/// Depth of a mesh thing in a pixel, infinite where its ray misses.
double literal_depth(Scene const& scene, SceneThing const& thing, Pixel p) {
  SceneCamera const& camera = scene.camera;
  Vector3d const ray((p.u - camera.cx_px) / camera.fx_px, (p.v - camera.cy_px) / camera.fy_px, 1);
  Se3 const T_thing_camera = pose_of(thing).inverse() * resting_pose(scene);
  return literal_mesh_hit(*mesh_of(thing), T_thing_camera.translation(),
                          T_thing_camera.rotation() * ray);
}

TEST(MeshThing, IsSeenWhereItsTrianglesAre) {
  Scene scene = small_scene({ring()});
  scene.camera.min_range_m = 0.1;
  RenderedView const view = RayCaster(scene).render(resting_pose(scene));
  std::size_t hits = 0;
  for (std::size_t i = 0; i < view.depth_m.size(); ++i) {
    Pixel const p = view.depth_m.pixel(i);
    double const depth_m = literal_depth(scene, scene.things[0], p);
    bool const hit = std::isfinite(depth_m);
    ASSERT_NEAR(view.depth_m[i], hit ? depth_m : 0.0, kToleranceM) << p.u << ", " << p.v;
    ASSERT_EQ(view.thing[i], hit ? 0 : -1) << p.u << ", " << p.v;
    ASSERT_EQ(view.incidence_cosine[i] > 0.0F, hit);
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 200U);
  EXPECT_LT(hits, view.depth_m.size() / 2);
}

TEST(MeshThing, HidesAndIsHiddenLikeABody) {
  Scene scene = small_scene({thing("wall", SceneShape::kBox, {0.1, 9, 9}, {3.05, 0, -4}), ring(),
                             thing("post", SceneShape::kCylinder, {0.03, 3}, {0.6, 0.1, 0})});
  scene.camera.min_range_m = 0.1;
  RayCaster const caster(scene);
  RenderedView const view = caster.render(resting_pose(scene));
  std::vector<std::size_t> counts(3);
  for (std::size_t i = 0; i < view.depth_m.size(); ++i) {
    ASSERT_GE(view.thing[i], 0);
    ++counts[static_cast<std::size_t>(view.thing[i])];
    if (view.thing[i] != 2) {
      double const depth_m = literal_depth(scene, scene.things[1], view.depth_m.pixel(i));
      ASSERT_NEAR(view.depth_m[i], std::min(depth_m, 3.0), kToleranceM);
      ASSERT_EQ(view.thing[i], depth_m < 3.0 ? 1 : 0);
    }
  }
  EXPECT_GT(counts[1], 100U);
  EXPECT_GT(counts[2], 100U);
  std::size_t alone = 0;
  for (std::size_t i = 0; i < view.depth_m.size(); ++i) {
    alone += std::isfinite(literal_depth(scene, scene.things[1], view.depth_m.pixel(i))) ? 1 : 0;
  }
  EXPECT_NEAR(visible_fraction(caster, 1, resting_pose(scene)),
              static_cast<double>(counts[1]) / static_cast<double>(alone), 1e-12);
}

TEST(MeshThing, LeavesNoGapBetweenItsTriangles) {
  // A square of two triangles whose common edge runs through the centres of many pixels.
  Scene scene = small_scene({mesh_thing(
      "plate", {{{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}},
      {2, 0, 1})});
  scene.camera.fx_px = scene.camera.fy_px = 50.0;
  RenderedView const view = RayCaster(scene).render(resting_pose(scene));
  for (int v = 0; v < 48; ++v) {
    for (int u = 8; u < 56; ++u) {
      ASSERT_EQ((view.thing[Pixel{u, v}]), 0) << u << ", " << v;
    }
  }
}

TEST(MeshThing, IsTheSameAtAnyNumberOfThreads) {
  Scene scene = small_scene({ring(), ring()});
  scene.things[1].name = "twin";
  RayCaster const caster(scene);
  RenderedView const many = caster.render(resting_pose(scene));
  tbb::global_control const one(tbb::global_control::max_allowed_parallelism, 1);
  RenderedView const alone = RayCaster(scene).render(resting_pose(scene));
  for (std::size_t i = 0; i < many.depth_m.size(); ++i) {
    ASSERT_EQ(many.depth_m[i], alone.depth_m[i]);
    ASSERT_EQ(many.color[i], alone.color[i]);
    ASSERT_NE(many.thing[i], 1) << "of two in one place the first is seen";
  }
}

TEST(MeshThing, OfKindObjectIsOfItsModelsType) {
  SceneThing one = ring();
  EXPECT_EQ(type_of(one), "ring");
  one.type = "crown";
  EXPECT_EQ(type_of(one), "crown");
}

std::string error_of(std::string const& text) {
  TempFolder const folder;
  write_text(folder / "a.yaml", "things:\n  - " + text + "\ncamera: {path: [{time_s: 0}]}\n");
  try {
    check_scene(load_scene(folder / "a.yaml"));
  } catch (InputError const& error) {
    std::string const message = error.what();
    std::size_t const at = message.find((folder / "a.yaml").string());
    return at == std::string::npos ? message
                                   : message.substr(0, at) + "FILE" +
                                         message.substr(at + (folder / "a.yaml").string().size());
  }
  return "no error";
}

TEST(MeshThing, ModelsAreFoundByNameAndLoaded) {
  EXPECT_EQ(error_of("{name: a, model: mug}"), "no error");
  EXPECT_EQ(error_of("{name: a, model: table}"), "no error");
  EXPECT_EQ(error_of("{name: a, model: mgu}"),
            "FILE: thing a: no model is called mgu; models are bottle, green-box, mug, table, "
            "others are told by their file");
  EXPECT_EQ(error_of("{name: a, model: mug, size_m: [1]}"),
            "scene FILE: a: its model says how large it is, leave out size_m");
  SceneThing forgotten = thing("a", SceneShape::kBox, {});
  forgotten.model = "mug";
  EXPECT_THROW(check_scene(small_scene({forgotten})), InputError);
}

TEST(MeshThing, AModelOfBodiesIsTheThingOfThatShape) {
  SceneThing table = thing("table", SceneShape::kBox, {}, {2, 0, 0.3});
  table.model = "table";
  TempFolder const folder;
  write_text(folder / "a.yaml",
             "things: [{name: table, kind: object, model: table, position_m: [2, 0, 0.3]}]\n");
  Scene scene = small_scene(load_scene(folder / "a.yaml").things);
  Scene const literal =
      small_scene({thing("table", SceneShape::kTable, {0.8, 1.2, 0.72, 0.04, 0.06}, {2, 0, 0.3})});
  RenderedView const view = RayCaster(scene).render(resting_pose(scene));
  RenderedView const expected = RayCaster(literal).render(resting_pose(scene));
  for (std::size_t i = 0; i < view.depth_m.size(); ++i) {
    ASSERT_EQ(view.depth_m[i], expected.depth_m[i]);
  }
  FrameTruth const truth = truth_of(scene, FrameIndex{0});
  ASSERT_EQ(truth.objects.size(), 1U);
  EXPECT_EQ(truth.objects[0].type, "table");
  EXPECT_GT(truth.objects[0].visible_fraction, 0.9);
}

// The mug's frame: it stands on z = 0, the handle along x.
TEST(MeshThing, TheProjectsMugIsAMug) {
  TempFolder const folder;
  write_text(folder / "a.yaml", "things: [{name: mug, kind: object, model: mug}]\n");
  SceneThing const mug = load_scene(folder / "a.yaml").things[0];
  Eigen::AlignedBox3d const box = bounds_of_thing(mug);
  EXPECT_NEAR((box.min() - Vector3d(-0.04, -0.04, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((box.max() - Vector3d(0.0685, 0.04, 0.097)).norm(), 0, 1e-4);
  EXPECT_NEAR(literal_mesh_hit(*mesh_of(mug), {0.01, 0.003, 1}, {0.001, 0.002, -1}), 0.995, 1e-6)
      << "hollow";
}

}  // namespace
}  // namespace credo::test
