#include "sim/tabletop_maker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "geometry/shapes/object_shape.hpp"
#include "geometry/shapes/surface_points.hpp"
#include "io/bop_models.hpp"
#include "sim/household.hpp"
#include "sim/tabletop_sets.hpp"
#include "sim/thing.hpp"
#include "support/recordings.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

ObjectModels household() {
  ObjectModels models;
  for (ObjectModel const& model : household_models()) {
    models.emplace(model.name, model);
  }
  return models;
}

Se3 pose_of_thing(TabletopThing const& thing) {
  return {rotation_of_rpy_deg(thing.rpy_deg), thing.position_m};
}

/// How deep the surface of one thing is within another, or below the table.
double deepest_m(TabletopScene const& scene, ObjectModels const& models) {
  ObjectShapes const shapes = shapes_of(models);
  double deepest = 0.0;
  for (TabletopThing const& a : scene.things) {
    if (a.model.empty()) {
      continue;
    }
    for (Eigen::Vector3d const& point : surface_points(models.at(a.model), 0.01)) {
      Eigen::Vector3d const p_world = pose_of_thing(a) * point;
      deepest = std::max(deepest, kTabletopHeight_m - p_world.z());
      for (TabletopThing const& b : scene.things) {
        if (&a != &b && !b.model.empty()) {
          Eigen::Vector3d const p_b = pose_of_thing(b).inverse() * p_world;
          deepest = std::max(deepest, -shapes.at(b.model).distance_to(p_b).distance_m);
        }
      }
    }
  }
  return deepest;
}

/// The least distance of a thing's surface to the table or to another thing.
double clearance_m(TabletopScene const& scene, std::size_t thing, ObjectModels const& models,
                   ObjectShapes const& shapes) {
  double least = 1.0;
  TabletopThing const& a = scene.things[thing];
  for (Eigen::Vector3d const& point : surface_points(models.at(a.model), 0.004)) {
    Eigen::Vector3d const p_world = pose_of_thing(a) * point;
    least = std::min(least, p_world.z() - kTabletopHeight_m);
    for (std::size_t other = 0; other < scene.things.size(); ++other) {
      if (other != thing) {
        TabletopThing const& b = scene.things[other];
        least = std::min(
            least, shapes.at(b.model).distance_to(pose_of_thing(b).inverse() * p_world).distance_m);
      }
    }
  }
  return least;
}

TEST(TabletopMaker, SparseScenesHaveThreeToEightThingsOfTheirOwnOnTheTable) {
  ObjectModels const models = household();
  TabletopMaker const maker(models);
  for (int seed = 1; seed <= 6; ++seed) {
    TabletopScene const scene = maker.make(TabletopKind::kSparse, "scene", seed);
    std::set<std::string> names;
    std::size_t known = 0;
    for (TabletopThing const& thing : scene.things) {
      if (!thing.model.empty()) {
        names.insert(thing.model);
        ++known;
      }
    }
    EXPECT_EQ(names.size(), known) << "one of each";
    EXPECT_GE(known, 3U);
    EXPECT_LE(known, 8U);
    EXPECT_GE(scene.things.size(), known + 1);
    EXPECT_LT(deepest_m(scene, models), 0.001) << seed;
  }
}

TEST(TabletopMaker, InClutterThingsTouchAndAreClearOfEachOther) {
  ObjectModels const models = household();
  ObjectShapes const shapes = shapes_of(models);
  TabletopMaker const maker(models);
  std::size_t raised = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    TabletopScene const scene = maker.make(TabletopKind::kClutter, "scene", seed);
    EXPECT_GE(scene.things.size(), 18U);
    EXPECT_LT(deepest_m(scene, models), 0.002) << seed;
    for (std::size_t i = 0; i < scene.things.size(); ++i) {
      // Nothing hangs in the air: what is let down stops within a cell's slope of something.
      EXPECT_LT(clearance_m(scene, i, models, shapes), 0.004) << scene.things[i].model;
      double low_m = 1.0;
      for (Eigen::Vector3d const& point : surface_points(models.at(scene.things[i].model), 0.01)) {
        low_m = std::min(low_m, (pose_of_thing(scene.things[i]) * point).z() - kTabletopHeight_m);
      }
      raised += low_m > 0.01 ? 1 : 0;
    }
  }
  EXPECT_GT(raised, 5U) << "some lie on others";
}

TEST(TabletopMaker, TheSameForTheSameSeedAlone) {
  TabletopMaker const maker(household());
  auto const text = [&](int seed) {
    return credo::text_of({maker.make(TabletopKind::kClutter, "scene", seed)});
  };
  EXPECT_EQ(text(5), text(5));
  EXPECT_NE(text(5), text(6));
}

TEST(TabletopMaker, RefusesWhatIsNoMesh) {
  ObjectModels models;
  models["ball"] = {"ball", std::vector<Solid>{SphereSolid{0.1}}, {}};
  EXPECT_THROW(TabletopMaker{models}, std::logic_error);
}

TEST(TabletopMaker, MakesTheFrozenSetsAnew) {
  CREDO_REQUIRE_RECORDING("objects/lmo");
  ObjectModels models = household();
  for (ObjectModel const& model : read_bop_models(recordings() / "objects" / "lmo", "lmo")) {
    models.emplace(model.name, model);
  }
  for (TabletopSet const& set : kTabletopSets) {
    std::filesystem::path const file =
        source_folder() / "bench/detection/sets" / (std::string(set.name) + ".txt");
    std::vector<TabletopScene> const scenes = make_scenes(set, models);
    EXPECT_EQ(scenes.size(), static_cast<std::size_t>(set.count));
    EXPECT_EQ(credo::text_of(scenes), text_of(file)) << set.name;
  }
  EXPECT_FALSE(tabletop_set("nonsense"));
  EXPECT_EQ(tabletop_set("clutter")->count, 20);
}

}  // namespace
}  // namespace credo::test
