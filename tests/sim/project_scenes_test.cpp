// The scenes of known objects show what they are for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <variant>

#include "sim/camera_path.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scene.hpp"
#include "sim/scene_time.hpp"
#include "sim/sim_source.hpp"
#include "sim/visibility.hpp"
#include "tools/scene_file.hpp"

namespace credo::test {
namespace {

Scene project_scene(std::string const& name) {
  Scene scene = load_scene(name);
  check_scene(scene);
  return scene;
}

std::size_t position_of(Scene const& scene, std::string const& name) {
  auto const found = std::find_if(scene.things.begin(), scene.things.end(),
                                  [&](SceneThing const& thing) { return thing.name == name; });
  return static_cast<std::size_t>(found - scene.things.begin());
}

/// Visible share of a thing in a frame; `alone` takes all others away.
double seen(Scene const& scene, std::int64_t frame, std::string const& name, bool alone = false) {
  double const time_s = scene_time_s(scene, FrameIndex{frame});
  std::size_t const position = position_of(scene, name);
  Scene shown = scene;
  if (alone) {
    shown.things = {things_at(scene, time_s)[position].value()};
    shown.events.clear();
  }
  return visible_fraction(RayCaster(shown, time_s), alone ? 0 : position,
                          camera_pose(scene.camera.path, time_s));
}

std::size_t frame_count(Scene const& scene) {
  return SimSource(scene, {}).frame_count();
}

TEST(ProjectScenes, TheBoxOnTheTableIsSeenFromAllSides) {
  Scene const scene = project_scene("box-on-table");
  ASSERT_EQ(frame_count(scene), 9U);
  for (std::int64_t i = 0; i < 9; ++i) {
    EXPECT_GE(seen(scene, i, "table"), 0.6) << i;
    EXPECT_GE(seen(scene, i, "box"), 0.6) << i;
  }
}

TEST(ProjectScenes, TheBottleMovesInThirdFrameAndIsNeverHidden) {
  Scene const scene = project_scene("bottle-moves");
  ASSERT_EQ(frame_count(scene), 6U);
  std::size_t const bottle = position_of(scene, "bottle");
  for (std::int64_t i = 0; i < 6; ++i) {
    EXPECT_GE(seen(scene, i, "table"), 0.6) << i;
    EXPECT_EQ(seen(scene, i, "table", true), 1.0) << "wholly in the picture, " << i;
    EXPECT_EQ(seen(scene, i, "bottle"), 1.0) << i;
    auto const now = things_at(scene, scene_time_s(scene, FrameIndex{i}))[bottle];
    ASSERT_TRUE(now.has_value());
    EXPECT_EQ(now->position_m[1], i < 2 ? 0.0 : -0.4);
  }
}

TEST(ProjectScenes, ThePersonHidesTheTableAndNothingIsTakenAway) {
  Scene const scene = project_scene("swap-and-occlude");
  ASSERT_EQ(frame_count(scene), 100U);
  for (char const* const name : {"bottle", "mug", "box"}) {
    EXPECT_EQ(seen(scene, 10, name), 1.0) << name;
    EXPECT_EQ(seen(scene, 95, name), 1.0) << name;
    int hidden = 0;
    for (std::int64_t i = 50; i < 80; ++i) {
      hidden += seen(scene, i, name) == 0.0 ? 1 : 0;
    }
    EXPECT_GE(hidden, 2) << name;
  }
  EXPECT_THAT(things_at(scene, 2.0)[position_of(scene, "box")]->position_m,
              testing::ElementsAre(1.85, -0.3, 0.72));
}

TEST(ProjectScenes, TheCorridorEndsWhereItBeganAndPeopleCrossIt) {
  Scene const scene = project_scene("corridor-loop");
  ASSERT_EQ(frame_count(scene), 267U);
  auto const pose = [&](std::int64_t frame) {
    return camera_pose(scene.camera.path, scene_time_s(scene, FrameIndex{frame}));
  };
  EXPECT_LT((pose(0).translation() - pose(266).translation()).norm(), 0.01);
  EXPECT_GT(pose(0).rotation().dot(pose(266).rotation()), 0.999);
  EXPECT_GT((pose(0).translation() - pose(133).translation()).norm(), 5.0);
  struct Meeting {
    char const* person;
    std::int64_t frame;
  };
  for (Meeting const& meeting :
       {Meeting{"first person", 20}, Meeting{"second person", 85}, Meeting{"third person", 150}}) {
    EXPECT_GT(seen(scene, meeting.frame, meeting.person), 0.5) << meeting.person;
  }
  for (char const* const name : {"table", "box", "mug", "bottle"}) {
    EXPECT_GT(seen(scene, 140, name), 0.5) << name;
    EXPECT_EQ(seen(scene, 10, name), 0.0) << name;
  }
  EXPECT_GT(seen(scene, 60, "second box"), 0.5);
}

TEST(ProjectScenes, TheRoomHasTwoHundredThingsInSight) {
  Scene const scene = project_scene("room-of-200");
  EXPECT_EQ(frame_count(scene), 80U);
  int things = 0;
  std::set<std::size_t> in_sight;
  for (std::int64_t const frame : {5, 40, 75}) {
    double const time_s = scene_time_s(scene, FrameIndex{frame});
    RayCaster const world(scene, time_s);
    Se3 const T_world_camera = camera_pose(scene.camera.path, time_s);
    things = 0;
    for (std::size_t i = 0; i < scene.things.size(); ++i) {
      if (scene.things[i].name.starts_with("thing ")) {
        ++things;
        if (visible_fraction(world, i, T_world_camera) > 0.3) {
          in_sight.insert(i);
        }
      }
    }
  }
  EXPECT_EQ(things, 200);
  EXPECT_GT(in_sight.size(), 150U);
}

TEST(ProjectScenes, SharesAgreeWithThePicture) {
  Scene const scene = project_scene("box-on-table");
  Scene alone = scene;
  std::size_t const table = position_of(scene, "table");
  alone.things = {scene.things[table]};
  for (std::int64_t const i : {0, 3, 8}) {
    Se3 const T = camera_pose(scene.camera.path, scene_time_s(scene, FrameIndex{i}));
    RenderedView const all = RayCaster(scene).render(T);
    RenderedView const one = RayCaster(alone).render(T);
    auto const seen_pixels =
        std::count(all.thing.begin(), all.thing.end(), static_cast<std::int32_t>(table));
    auto const pixels = std::count(one.thing.begin(), one.thing.end(), 0);
    EXPECT_NEAR(seen(scene, i, "table"),
                static_cast<double>(seen_pixels) / static_cast<double>(pixels), 0.02);
  }
}

}  // namespace
}  // namespace credo::test
