// What is where at a time, and that the camera sees it so.
#include "sim/scene_time.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "core/error.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scenes.hpp"
#include "sim/sim_source.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;

/// Ten frames a second from 2 s to 3 s. The cup appears at 2.25 s, moves at 2.4 s, goes at 2.6 s
/// and is back at 2.8 s; the block moves at 2.4 s.
Scene eventful_scene() {
  Scene scene = small_scene({thing("block", SceneShape::kBox, {0.2, 0.2, 0.2}, {3, 0.5, 0.9}),
                             thing("cup", SceneShape::kBox, {0.2, 0.1, 0.3}, {2, -0.3, 0.9})});
  scene.things[1].rpy_deg = {0, 0, 10};
  scene.camera.frames_per_s = 10.0;
  scene.camera.path = {{2, {0, 0, 1}, {1, 0, 1}}, {3, {0, 0.1, 1}, {1, 0.1, 1}}};
  scene.events = {{2.25, "cup", SceneChange::kAppeared, {}, {}, {}},
                  {2.4, "cup", SceneChange::kMoved, {}, {2, 0, 0.9}, {}},
                  {2.4, "block", SceneChange::kMoved, {}, {3, 0, 0.9}, {0, 0, 45}},
                  {2.6, "cup", SceneChange::kRemoved, {}, {}, {}},
                  {2.8, "cup", SceneChange::kAppeared, {}, {2, 0.3, 0.9}, {0, 0, 20}}};
  return scene;
}

TEST(SceneTime, AFramesTimeCountsFromTheFirstWaypoint) {
  Scene const scene = eventful_scene();
  EXPECT_EQ(scene_time_s(scene, FrameIndex{0}), 2.0);
  EXPECT_DOUBLE_EQ(scene_time_s(scene, FrameIndex{7}), 2.7);
  EXPECT_DOUBLE_EQ(scene_time_s(scene, FrameIndex{1000}), 102.0);
}

TEST(SceneTime, AnEventHoldsFromTheFirstFrameAtOrAfterItsTime) {
  Scene scene = eventful_scene();
  std::vector<std::size_t> counts;
  for (int i = 0; i <= 10; ++i) {
    counts.push_back(event_count_at(scene, scene_time_s(scene, FrameIndex{i})));
  }
  EXPECT_THAT(counts, ElementsAre(0, 0, 0, 1, 3, 3, 4, 4, 5, 5, 5));
  scene.camera.path[0].time_s = 0.1;
  scene.events = {{0.8, "cup", SceneChange::kRemoved, {}, {}, {}}};
  ASSERT_LT(scene_time_s(scene, FrameIndex{7}), 0.8) << "which rounding makes of 0.1 + 0.7";
  EXPECT_EQ(event_count_at(scene, scene_time_s(scene, FrameIndex{7})), 1U);
  EXPECT_EQ(event_count_at(scene, scene_time_s(scene, FrameIndex{6})), 0U);
}

TEST(SceneTime, WhatAppearsFirstIsAbsentBefore) {
  PresentThings const things = things_at(eventful_scene(), 0.0);
  ASSERT_EQ(things.size(), 2U);
  EXPECT_TRUE(things[0].has_value());
  EXPECT_FALSE(things[1].has_value());
}

TEST(SceneTime, ThingsAppearMoveGoAndComeBack) {
  Scene const scene = eventful_scene();
  PresentThings things = things_at(scene, 2.3);
  ASSERT_TRUE(things[1].has_value());
  EXPECT_THAT(things[1]->position_m, ElementsAre(2, -0.3, 0.9)) << "its own";
  EXPECT_THAT(things[1]->rpy_deg, ElementsAre(0, 0, 10));
  things = things_at(scene, 2.5);
  ASSERT_TRUE(things[0].has_value() && things[1].has_value());
  EXPECT_THAT(things[0]->position_m, ElementsAre(3, 0, 0.9));
  EXPECT_THAT(things[0]->rpy_deg, ElementsAre(0, 0, 45));
  EXPECT_THAT(things[1]->position_m, ElementsAre(2, 0, 0.9));
  EXPECT_THAT(things[1]->rpy_deg, ElementsAre(0, 0, 10)) << "as it was";
  EXPECT_FALSE(things_at(scene, 2.7)[1].has_value());
  things = things_at(scene, 99);
  ASSERT_TRUE(things[1].has_value());
  EXPECT_EQ(things[1]->name, "cup");
  EXPECT_THAT(things[1]->position_m, ElementsAre(2, 0.3, 0.9));
  EXPECT_THAT(things[1]->rpy_deg, ElementsAre(0, 0, 20));
}

TEST(SceneTime, WhatComesBackStandsWhereTheSceneHasIt) {
  Scene scene = eventful_scene();
  scene.events.back().position_m.clear();
  scene.events.back().rpy_deg.clear();
  std::optional<SceneThing> const cup = things_at(scene, 3)[1];
  ASSERT_TRUE(cup.has_value());
  EXPECT_THAT(cup->position_m, ElementsAre(2, -0.3, 0.9));
  EXPECT_THAT(cup->rpy_deg, ElementsAre(0, 0, 10));
}

/// The scene for good as it stands at a time.
Scene frozen(Scene scene, double time_s) {
  PresentThings const things = things_at(scene, time_s);
  scene.events.clear();
  scene.things.clear();
  for (auto const& present : things) {
    if (present.has_value()) {
      scene.things.push_back(*present);
    }
  }
  return scene;
}

void expect_frames_of_the_moment(Scene const& scene) {
  SimSource source(scene, {});
  for (int i = 0; i <= 10; ++i) {
    FramePtr const frame = std::get<FramePtr>(source.next());
    RenderedView const expected =
        RayCaster(frozen(scene, scene_time_s(scene, FrameIndex{i}))).render(frame->T_source_camera);
    std::size_t covered = 0;
    for (std::size_t p = 0; p < expected.depth_m.size(); ++p) {
      ASSERT_EQ(frame->color[p], expected.color[p]) << i;
      ASSERT_EQ(frame->cloud_camera.valid(p), expected.depth_m[p] > 0.0F) << i;
      covered += expected.depth_m[p] > 0.0F ? 1 : 0;
    }
    EXPECT_GT(covered, 10U);
  }
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(source.next()));
}

TEST(SceneTime, TheSourceShowsEachFrameWithTheThingsAsTheyStandThen) {
  expect_frames_of_the_moment(eventful_scene());
}

TEST(SceneTime, TheSourceShowsWhatWalksWhereItIsInEachFrame) {
  Scene scene = eventful_scene();
  scene.events.erase(scene.events.begin() + 2);
  scene.things[0].position_m = {0, 0, 0};
  scene.things[0].path = {{2.05, {3, 0.5, 0.9}, 0}, {2.45, {2.5, -0.5, 0.9}, 45}};
  expect_frames_of_the_moment(scene);
}

TEST(SceneTime, TheWorldChangesByEventsAndByMotion) {
  Scene scene = eventful_scene();
  EXPECT_FALSE(world_changes(scene, 2.0, 2.2));
  EXPECT_TRUE(world_changes(scene, 2.2, 2.3));
  EXPECT_TRUE(world_changes(scene, 2.3, 2.2)) << "back too";
  scene.events.clear();
  scene.things[0].position_m = {0, 0, 0};
  scene.things[0].path = {{2.1, {3, 0.5, 0.9}, 0}, {2.2, {3, 0.5, 0.9}, 45}};
  EXPECT_FALSE(world_changes(scene, 2.0, 2.1));
  EXPECT_TRUE(world_changes(scene, 2.1, 2.15));
  EXPECT_TRUE(world_changes(scene, 2.15, 2.2));
  EXPECT_FALSE(world_changes(scene, 2.2, 9.0));
}

TEST(SceneTime, WhatIsAwayIsKnownWhereItStoodOrWill) {
  Scene scene = eventful_scene();
  EXPECT_THAT(last_known(scene, 1, 2.0).position_m, ElementsAre(2, -0.3, 0.9)) << "will";
  EXPECT_THAT(last_known(scene, 1, 2.45).position_m, ElementsAre(2, 0, 0.9)) << "is";
  EXPECT_THAT(last_known(scene, 1, 2.7).position_m, ElementsAre(2, 0, 0.9)) << "stood";
  scene.events = {{2.1, "cup", SceneChange::kSwapped, "block", {}, {}},
                  {2.2, "cup", SceneChange::kRemoved, {}, {}, {}},
                  {2.3, "block", SceneChange::kRemoved, {}, {}, {}}};
  EXPECT_THAT(last_known(scene, 1, 2.5).position_m, ElementsAre(3, 0.5, 0.9));
  EXPECT_THAT(last_known(scene, 0, 2.5).position_m, ElementsAre(2, -0.3, 0.9));
}

TEST(SceneTime, ARenderedThingKeepsItsNumberWhenAnotherIsAbsent) {
  Scene scene = eventful_scene();
  scene.events = {{1, "block", SceneChange::kRemoved, {}, {}, {}}};
  RenderedView const view = RayCaster(scene, 1.0).render(Se3{});
  for (double const time_s : {0.0, 1.0}) {
    RenderedView const seen =
        RayCaster(scene, time_s)
            .render({Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Eigen::Vector3d(0, 0, 1)});
    bool block = false;
    bool cup = false;
    for (std::int32_t const number : seen.thing) {
      block = block || number == 0;
      cup = cup || number == 1;
    }
    EXPECT_EQ(block, time_s < 1.0);
    EXPECT_TRUE(cup);
  }
}

TEST(SceneTime, TheSourceRefusesEventsThatCannotBe) {
  Scene scene = eventful_scene();
  scene.events[0].thing = "mug";
  EXPECT_THROW(SimSource(scene, {}), InputError);
}

}  // namespace
}  // namespace credo::test
