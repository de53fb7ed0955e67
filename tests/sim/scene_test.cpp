// Scenes are files that people write: what is wrong with one is told in one line.
#include "sim/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "config/yaml_config.hpp"
#include "core/error.hpp"
#include "sim/scenes.hpp"
#include "support/paths.hpp"
#include "support/temp_folder.hpp"
#include "tools/scene_file.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

std::string error_of(std::function<void()> const& work) {
  try {
    work();
  } catch (InputError const& error) {
    return error.what();
  }
  return "no error";
}

Scene good_scene() {
  Scene scene = small_scene({thing("floor", SceneShape::kBox, {8, 8, 0.05}, {0, 0, -0.05}),
                             thing("ball", SceneShape::kSphere, {0.1}, {2, 0, 0})});
  scene.camera.path = {{0, {0, 0, 1}, {2, 0, 0}}, {1, {0, 1, 1}, {2, 0, 0}}};
  return scene;
}

std::string check_error(std::function<void(Scene&)> const& spoil) {
  Scene scene = good_scene();
  spoil(scene);
  return error_of([&] { check_scene(scene); });
}

TEST(Scene, IsReadFromYaml) {
  TempFolder const folder;
  write_text(folder / "a.yaml", R"(
things:
  - {name: table, kind: object, type: desk, shape: table, size_m: [0.8, 1.2, 0.72, 0.04, 0.06], position_m: [2, 0, 0], rpy_deg: [0, 0, 30], color: [1, 2, 3], checker_m: 0.1}
  - {name: mug, shape: cylinder, size_m: [0.04, 0.1]}
  - {name: cat, shape: sphere, size_m: [0.2], texture: {kind: stripes, size_m: 0.03}, path: [{time_s: 1, position_m: [1, 2, 0]}, {time_s: 2, position_m: [3, 2, 0], yaw_deg: 90}]}
events:
  - {time_s: 0.5, thing: mug, what: removed}
  - {time_s: 2, thing: mug, what: appeared, position_m: [1, 2, 3], rpy_deg: [0, 0, 90]}
  - {time_s: 3, thing: mug, what: swapped, with: table}
camera:
  width_px: 320
  frames_per_s: 15
  path:
    - {time_s: 0.5, position_m: [0, 1, 2], look_at_m: [3, 4, 5]}
)");
  Scene scene;
  load_config(fields(scene), {folder / "a.yaml"}, {});
  ASSERT_EQ(scene.things.size(), 3U);
  SceneThing const& table = scene.things[0];
  EXPECT_EQ(table.kind, SceneKind::kObject);
  EXPECT_EQ(table.type, "desk");
  EXPECT_EQ(table.shape, SceneShape::kTable);
  EXPECT_THAT(table.size_m, ElementsAre(0.8, 1.2, 0.72, 0.04, 0.06));
  EXPECT_THAT(table.rpy_deg, ElementsAre(0, 0, 30));
  EXPECT_THAT(table.color, ElementsAre(1, 2, 3));
  EXPECT_EQ(table.checker_m, 0.1);
  EXPECT_EQ(scene.things[1].kind, SceneKind::kStuff);
  EXPECT_EQ(scene.things[1].type, "");
  EXPECT_EQ(scene.things[1].texture.kind, SceneTexture::Kind::kPlain);
  EXPECT_EQ(scene.things[2].texture.kind, SceneTexture::Kind::kStripes);
  EXPECT_EQ(scene.things[2].texture.size_m, 0.03);
  EXPECT_THAT(scene.things[1].path, ElementsAre());
  ASSERT_EQ(scene.things[2].path.size(), 2U);
  EXPECT_EQ(scene.things[2].path[1].time_s, 2.0);
  EXPECT_THAT(scene.things[2].path[1].position_m, ElementsAre(3, 2, 0));
  EXPECT_EQ(scene.things[2].path[0].yaw_deg, 0.0);
  EXPECT_EQ(scene.things[2].path[1].yaw_deg, 90.0);
  ASSERT_EQ(scene.events.size(), 3U);
  EXPECT_EQ(scene.events[0].time_s, 0.5);
  EXPECT_EQ(scene.events[0].thing, "mug");
  EXPECT_EQ(scene.events[0].what, SceneChange::kRemoved);
  EXPECT_THAT(scene.events[0].position_m, ElementsAre());
  EXPECT_EQ(scene.events[1].what, SceneChange::kAppeared);
  EXPECT_THAT(scene.events[1].position_m, ElementsAre(1, 2, 3));
  EXPECT_THAT(scene.events[1].rpy_deg, ElementsAre(0, 0, 90));
  EXPECT_EQ(scene.events[2].what, SceneChange::kSwapped);
  EXPECT_EQ(scene.events[2].with, "table");
  EXPECT_EQ(scene.camera.width_px, 320);
  EXPECT_EQ(scene.camera.frames_per_s, 15.0);
  ASSERT_EQ(scene.camera.path.size(), 1U);
  EXPECT_EQ(scene.camera.path[0].time_s, 0.5);
  EXPECT_THAT(scene.camera.path[0].look_at_m, ElementsAre(3, 4, 5));
}

TEST(Scene, YamlErrorsSayWhere) {
  TempFolder const folder;
  write_text(folder / "a.yaml",
             "things:\n  - {name: a, shape: cone}\n  - {name: b, size_m: [0.1, -1]}\n"
             "  - {nmae: c}\n  - {name: d, position_m: [1, 2]}\ncamera:\n  width_px: 0\n");
  Scene scene;
  std::string const file = (folder / "a.yaml").string();
  EXPECT_EQ(error_of([&] { load_config(fields(scene), {file}, {}); }),
            file + ":2:15: things[0].shape = cone: must be one of box, cylinder, sphere, table\n" +
                file + ":3:15: things[1].size_m[1] = -1: must be in [0.0001, 1000] m\n" +  //
                file + ":4:6: unknown key things[2].nmae (did you mean name?)\n" +         //
                file + ":5:15: things[3].position_m: must be a list of 3 numbers\n" +      //
                file + ":7:3: camera.width_px = 0: must be in [1, 4096] px");
}

TEST(Scene, ThatIsCompletePasses) {
  EXPECT_EQ(check_error([](Scene&) {}), "no error");
}

TEST(Scene, WithoutThingsOrPathIsRefused) {
  EXPECT_EQ(check_error([](Scene& scene) { scene.things.clear(); }), "scene test: has no things");
  EXPECT_EQ(check_error([](Scene& scene) { scene.camera.path.clear(); }),
            "scene test: camera.path needs at least one waypoint");
}

TEST(Scene, NamesAreNeededAndUnique) {
  EXPECT_EQ(check_error([](Scene& scene) { scene.things[1].name = "floor"; }),
            "scene test: every thing needs a name of its own, 'floor' is not");
  EXPECT_EQ(check_error([](Scene& scene) { scene.things[1].name = ""; }),
            "scene test: every thing needs a name of its own, '' is not");
}

TEST(Scene, SizesAreThoseOfTheShape) {
  EXPECT_EQ(check_error([](Scene& scene) { scene.things[1].shape = SceneShape::kTable; }),
            "scene test: ball: its shape needs 5 numbers in size_m, has 1");
  EXPECT_EQ(check_error([](Scene& scene) { scene.things[1].size_m.clear(); }),
            "scene test: ball: its shape needs 1 numbers in size_m, has 0");
  EXPECT_EQ(check_error([](Scene& scene) { scene.things[0].size_m[2] = 0; }),
            "scene test: floor: every number of size_m must be positive");
}

TEST(Scene, TheCameraHasAWayToGo) {
  EXPECT_EQ(check_error([](Scene& scene) { scene.camera.path[1].time_s = 0; }),
            "scene test: camera.path[1]: time_s must rise");
  EXPECT_EQ(check_error([](Scene& scene) {
              scene.camera.path[1].look_at_m = {0, 1, 1};
            }),
            "scene test: camera.path[1] looks at where it is");
}

TEST(Scene, AThingHasOneTexture) {
  EXPECT_EQ(check_error([](Scene& scene) {
              scene.things[1].checker_m = 0.1;
              scene.things[1].texture.kind = SceneTexture::Kind::kNoise;
            }),
            "scene test: ball: give checker_m or texture, not both");
}

TEST(Scene, OnlyObjectsHaveAType) {
  EXPECT_EQ(check_error([](Scene& scene) { scene.things[1].type = "globe"; }),
            "scene test: ball: only a thing of kind object has a type");
  EXPECT_EQ(check_error([](Scene& scene) {
              scene.things[1].type = "globe";
              scene.things[1].kind = SceneKind::kObject;
            }),
            "no error");
}

std::string events_error(std::vector<SceneEvent> const& events) {
  return check_error([&](Scene& scene) { scene.events = events; });
}

SceneEvent const kRemoved{1, "ball", SceneChange::kRemoved, {}, {}, {}};
SceneEvent const kAppeared{2, "ball", SceneChange::kAppeared, {}, {}, {}};
SceneEvent const kMoved{3, "ball", SceneChange::kMoved, {}, {1, 1, 0}, {}};

TEST(Scene, EventsThatCanFollowEachOtherPass) {
  EXPECT_EQ(events_error({kRemoved, kAppeared, kMoved}), "no error");
  EXPECT_EQ(events_error({kAppeared, kMoved}), "no error") << "it is absent at first";
  SceneEvent floor = kMoved;
  floor.thing = "floor";
  EXPECT_EQ(events_error({kMoved, floor}), "no error") << "two things at one time";
}

TEST(Scene, EventsThatCannotBeAreRefused) {
  EXPECT_EQ(events_error({{1, "mug", SceneChange::kRemoved, {}, {}, {}}}),
            "scene test: events[0]: there is no thing 'mug'");
  EXPECT_EQ(events_error({{-1, "ball", SceneChange::kRemoved, {}, {}, {}}}),
            "scene test: events[0]: time_s must not be negative");
  EXPECT_EQ(events_error({kRemoved, {0.5, "floor", SceneChange::kRemoved, {}, {}, {}}}),
            "scene test: events[1]: time_s must rise, only different things may share a time");
  EXPECT_EQ(events_error({kMoved, kMoved}),
            "scene test: events[1]: time_s must rise, only different things may share a time");
  EXPECT_EQ(events_error({kRemoved, kMoved}),
            "scene test: events[1]: ball is absent, it cannot be moved, swapped or removed");
  EXPECT_EQ(events_error({kRemoved, {2, "ball", SceneChange::kRemoved, {}, {}, {}}}),
            "scene test: events[1]: ball is absent, it cannot be moved, swapped or removed");
  EXPECT_EQ(events_error({kAppeared, {5, "ball", SceneChange::kAppeared, {}, {}, {}}}),
            "scene test: events[1]: ball is there already, it cannot appear");
}

TEST(Scene, EventsSayWhatTheyMustAndNoMore) {
  EXPECT_EQ(events_error({{1, "ball", SceneChange::kMoved, {}, {1, 2}, {}}}),
            "scene test: events[0]: position_m needs 0 or 3 numbers, has 2");
  EXPECT_EQ(events_error({{1, "ball", SceneChange::kMoved, {}, {1, 2, 3}, {4}}}),
            "scene test: events[0]: rpy_deg needs 0 or 3 numbers, has 1");
  EXPECT_EQ(events_error({{1, "ball", SceneChange::kMoved, {}, {}, {0, 0, 90}}}),
            "scene test: events[0]: what is moved needs position_m");
  EXPECT_EQ(events_error({{1, "ball", SceneChange::kRemoved, {}, {1, 2, 3}, {}}}),
            "scene test: events[0]: what is removed has no position_m");
  EXPECT_EQ(events_error({{1, "ball", SceneChange::kRemoved, {}, {}, {0, 0, 90}}}),
            "scene test: events[0]: what is removed has no rpy_deg");
}

SceneEvent swap_of(std::string const& thing, std::string const& with) {
  return {1, thing, SceneChange::kSwapped, with, {}, {}};
}

TEST(Scene, ThingsThatAreThereMaySwap) {
  EXPECT_EQ(events_error({swap_of("ball", "floor"), kMoved}), "no error");
}

TEST(Scene, SwapsThatCannotBeAreRefused) {
  EXPECT_EQ(events_error({swap_of("ball", "mug")}),
            "scene test: events[0]: there is no thing 'mug'");
  EXPECT_EQ(events_error({swap_of("ball", "")}), "scene test: events[0]: there is no thing ''");
  EXPECT_EQ(events_error({swap_of("ball", "ball")}),
            "scene test: events[0]: ball cannot trade places with itself");
  EXPECT_EQ(
      events_error({swap_of("floor", "ball"), {1, "ball", SceneChange::kRemoved, {}, {}, {}}}),
      "scene test: events[1]: time_s must rise, only different things may share a time");
  SceneEvent late = swap_of("floor", "ball");
  late.time_s = 2;
  EXPECT_EQ(events_error({kRemoved, late}),
            "scene test: events[1]: ball is absent, it cannot be moved, swapped or removed");
  SceneEvent placed = swap_of("floor", "ball");
  placed.position_m = {1, 2, 3};
  EXPECT_EQ(events_error({placed}), "scene test: events[0]: what is swapped has no position_m");
  EXPECT_EQ(events_error({{1, "ball", SceneChange::kMoved, "floor", {1, 2, 3}, {}}}),
            "scene test: events[0]: only what is swapped is so with another thing");
}

std::string path_error(std::vector<ThingWaypoint> const& path,
                       std::vector<SceneEvent> const& events = {}) {
  return check_error([&](Scene& scene) {
    scene.things[1].path = path;
    scene.things[1].position_m = {0, 0, 0};
    scene.events = events;
  });
}

TEST(Scene, AThingMayMoveAndComeAndGo) {
  EXPECT_EQ(path_error({{1, {1, 0, 0}, 0}, {2, {2, 0, 0}, 90}}, {kRemoved, kAppeared}), "no error");
}

TEST(Scene, PathsThatCannotBeAreRefused) {
  std::vector<ThingWaypoint> const path = {{1, {1, 0, 0}, 0}, {2, {2, 0, 0}, 0}};
  EXPECT_EQ(path_error({{1, {1, 0, 0}, 0}, {1, {2, 0, 0}, 0}}),
            "scene test: ball: path[1]: time_s must rise");
  EXPECT_EQ(check_error([&](Scene& scene) { scene.things[1].path = path; }),
            "scene test: ball: its path says where it is, leave out position_m");
  EXPECT_EQ(path_error(path, {kMoved}),
            "scene test: events[0]: ball has a path, it cannot be moved or swapped");
  EXPECT_EQ(path_error(path, {swap_of("floor", "ball")}),
            "scene test: events[0]: ball has a path, it cannot be moved or swapped");
  EXPECT_EQ(path_error(path, {{1, "ball", SceneChange::kAppeared, {}, {1, 2, 3}, {}}}),
            "scene test: events[0]: ball has a path, it appears where that has it");
}

TEST(Scene, IsFoundByNameOrFile) {
  EXPECT_EQ(find_scene("first-light").filename(), "first-light.yaml");
  TempFolder const folder;
  write_text(folder / "mine.yaml", "");
  EXPECT_EQ(find_scene((folder / "mine.yaml").string()), folder / "mine.yaml");
  EXPECT_EQ(
      error_of([&] { find_scene("nowhere"); }),
      "sim:nowhere: no such scene or file; scenes are bottle-moves, box-on-table, cluttered-table, "
      "corridor-loop, first-light, flush-boxes, pen-on-table, room-of-200, swap-and-occlude, "
      "table-before-wall, thesis-3.4.1, thesis-3.4.2, thesis-3.4.3, "
      "thesis-3.4.4, thesis-4.4.1, thesis-4.4.2, thesis-4.4.3, thesis-4.4.4, wall-and-floor");
  EXPECT_NE(error_of([&] { find_scene("../scenes/first-light"); }), "no error")
      << "a name is no way into other folders";
  EXPECT_NE(error_of([&] { find_scene(folder.path().string()); }), "no error");
}

TEST(Scene, EveryOneOfTheProjectIsGood) {
  std::set<std::string> names;
  for (auto const& entry : fs::directory_iterator(source_folder() / "scenes")) {
    if (entry.is_directory()) {
      continue;  // priors
    }
    EXPECT_EQ(error_of([&] { check_scene(load_scene(entry.path())); }), "no error");
    names.insert(entry.path().stem().string());
  }
  EXPECT_TRUE(names.count("first-light") == 1);
}

}  // namespace
}  // namespace credo::test
