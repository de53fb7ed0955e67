#include "sim/truth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "sim/scenes.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A room with one of everything, ten frames a second for a second.
Scene room() {
  SceneThing floor = thing("floor", SceneShape::kBox, {8, 8, 0.05}, {0, 0, -0.05});
  floor.kind = SceneKind::kGround;
  SceneThing wall = thing("wall", SceneShape::kBox, {0.1, 4, 2.5}, {3.95, 0, 0});
  wall.kind = SceneKind::kWall;
  Scene scene =
      small_scene({floor, thing("ball", SceneShape::kSphere, {0.2}, {2, 0.5, 0}), wall,
                   object("box_1", "box", SceneShape::kBox, {0.3, 0.3, 0.3}, {2, -0.5, 0}),
                   thing("post", SceneShape::kCylinder, {0.1, 1.0}, {3, 0, 0})});
  scene.camera.frames_per_s = 10;
  scene.camera.path = {{0.0, {0, 0, 1}, {2, 0, 0.5}}, {1.0, {0, 0.2, 1}, {2, 0, 0.5}}};
  return scene;
}

SceneEvent event(double time_s, std::string thing, SceneChange what,
                 std::vector<double> position_m = {}) {
  return {time_s, std::move(thing), what, {}, std::move(position_m), {}};
}

TEST(Truth, LabelsCountWithinTheirKinds) {
  EXPECT_THAT(labels_of_things(room()), ElementsAre(1000, 4000, 2000, 3000, 4001));
}

TEST(Truth, TellsWhereEverythingIs) {
  FrameTruth const truth = truth_of(room(), FrameIndex{0});
  ASSERT_TRUE(truth.floor.has_value());
  EXPECT_NEAR(truth.floor->height_m, 0.0, 1e-12);
  ASSERT_EQ(truth.walls.size(), 1U);
  // The side that faces the camera.
  EXPECT_TRUE(truth.walls[0].segment_start_m.isApprox(Eigen::Vector2d(3.9, -2), 1e-12));
  EXPECT_TRUE(truth.walls[0].segment_end_m.isApprox(Eigen::Vector2d(3.9, 2), 1e-12));
  EXPECT_TRUE(truth.walls[0].normal.isApprox(-Eigen::Vector3d::UnitX(), 1e-12));
  ASSERT_EQ(truth.objects.size(), 1U);
  EXPECT_EQ(truth.objects[0].id, "box_1");
  EXPECT_EQ(truth.objects[0].type, "box");
  EXPECT_GT(truth.objects[0].visible_fraction, 0.95);
  ASSERT_EQ(truth.stuff.size(), 2U);
  EXPECT_TRUE(truth.stuff[0].pose.translation().isApprox(Eigen::Vector3d(2, 0.5, 0)));
  EXPECT_THAT(truth.events, IsEmpty());
}

// A wall seen from its other side is told by that side.
TEST(Truth, AWallsSideIsTheCameras) {
  Scene scene = room();
  scene.camera.path = {{0.0, {8, 0, 1}, {4, 0, 1}}};
  FrameTruth const truth = truth_of(scene, FrameIndex{0});
  EXPECT_TRUE(truth.walls[0].normal.isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_NEAR(truth.walls[0].segment_start_m.x(), 4.0, 1e-12);
}

TEST(Truth, EventsAreToldInTheirFrameAndPosesFollow) {
  Scene scene = room();
  scene.events = {event(0.25, "ball", SceneChange::kMoved, {1.5, 0.5, 0}),
                  event(0.45, "post", SceneChange::kRemoved),
                  event(0.65, "post", SceneChange::kAppeared, {3, 1, 0})};
  std::vector<std::string> told;
  for (std::int64_t i = 0; i < 10; ++i) {
    FrameTruth const truth = truth_of(scene, FrameIndex{i});
    for (TrueEvent const& one : truth.events) {
      told.push_back(std::to_string(i) + " " + one.what + " " + one.id);
    }
    TrueThing const& ball = truth.stuff[0];
    TrueThing const& post = truth.stuff[1];
    EXPECT_DOUBLE_EQ(ball.pose.translation().x(), i < 3 ? 2.0 : 1.5) << i;
    EXPECT_EQ(post.present, i < 5 || i >= 7) << i;
    EXPECT_EQ(post.label, 4001) << "also while it is away";
    EXPECT_DOUBLE_EQ(post.pose.translation().y(), i < 7 ? 0.0 : 1.0) << i;
    EXPECT_EQ(post.visible_fraction > 0, post.present) << i;
  }
  EXPECT_THAT(told, ElementsAre("3 moved ball", "5 removed post", "7 appeared post"));
}

/// "3 moved ball" for each event of the first frames.
std::vector<std::string> events_of(Scene const& scene, std::int64_t frames) {
  std::vector<std::string> told;
  for (std::int64_t i = 0; i < frames; ++i) {
    for (TrueEvent const& one : truth_of(scene, FrameIndex{i}).events) {
      told.push_back(std::to_string(i) + " " + one.what + " " + one.id);
    }
  }
  return told;
}

TEST(Truth, ASwapIsTwoThingsMoved) {
  Scene scene = room();
  scene.things[3].rpy_deg = {0, 0, 30};
  scene.events = {{0.35, "ball", SceneChange::kSwapped, "box_1", {}, {}}};
  EXPECT_THAT(events_of(scene, 10), ElementsAre("4 moved ball", "4 moved box_1"));
  for (std::int64_t const i : {3, 4, 9}) {
    FrameTruth const truth = truth_of(scene, FrameIndex{i});
    EXPECT_DOUBLE_EQ(truth.stuff[0].pose.translation().y(), i < 4 ? 0.5 : -0.5) << i;
    EXPECT_DOUBLE_EQ(truth.objects[0].pose.translation().y(), i < 4 ? -0.5 : 0.5) << i;
    EXPECT_TRUE(truth.objects[0].pose.rotation().isApprox(rotation_of_rpy_deg({0, 0, 30})));
  }
}

/// The ball walks from 0.2 s to 0.8 s, with a rest from 0.4 s to 0.6 s.
Scene walking_room() {
  Scene scene = room();
  scene.things[1].position_m = {0, 0, 0};
  scene.things[1].rpy_deg = {0, 0, 10};
  scene.things[1].path = {{0.2, {2, 0.5, 0}, 0},
                          {0.4, {2, 0.3, 0}, 0},
                          {0.6, {2, 0.3, 0}, 0},
                          {0.8, {2, 0.1, 0.2}, 90}};
  return scene;
}

TEST(Truth, WhatWalksIsWhereItsPathHasItInEachFrame) {
  Scene const scene = walking_room();
  std::vector<double> const y = {0.5, 0.5, 0.5, 0.4, 0.3, 0.3, 0.3, 0.2, 0.1, 0.1};
  for (std::size_t i = 0; i < y.size(); ++i) {
    TrueThing const ball = truth_of(scene, FrameIndex{static_cast<std::int64_t>(i)}).stuff[0];
    EXPECT_NEAR(ball.pose.translation().y(), y[i], 1e-12) << i;
    EXPECT_NEAR(ball.pose.translation().z(), i < 7 ? 0.0 : i == 7 ? 0.1 : 0.2, 1e-12) << i;
    double const yaw_deg = 10 + (i < 7 ? 0 : i == 7 ? 45 : 90);
    EXPECT_TRUE(ball.pose.rotation().isApprox(rotation_of_rpy_deg({0, 0, yaw_deg}))) << i;
  }
}

TEST(Truth, WhatWalksIsToldWhereItBeginsAndWhereItComesToRest) {
  EXPECT_THAT(events_of(walking_room(), 15),
              ElementsAre("3 moved ball", "4 moved ball", "7 moved ball", "8 moved ball"));
  Scene away = walking_room();
  away.events = {event(0.35, "ball", SceneChange::kRemoved),
                 event(0.55, "ball", SceneChange::kAppeared)};
  EXPECT_THAT(events_of(away, 15), ElementsAre("3 moved ball", "4 removed ball", "6 appeared ball",
                                               "7 moved ball", "8 moved ball"));
  Scene early = walking_room();
  early.camera.path[0].time_s = 0.3;
  EXPECT_THAT(events_of(early, 2), ElementsAre("1 moved ball")) << "in motion from the start";
}

TEST(Truth, RoundingIsNoMotion) {
  Scene scene = walking_room();
  scene.camera.path[0].time_s = 0.1;
  scene.camera.path[1].time_s = 1.1;
  scene.things[1].path = {{0.4, {2, 0.5, 0}, 0}, {0.8, {2, 0.1, 0}, 0}};
  ASSERT_LT(0.1 + 7 / 10.0, 0.8) << "a frame at the rest's time seems to come before it";
  EXPECT_THAT(events_of(scene, 10), ElementsAre("4 moved ball", "7 moved ball"));
}

TEST(Truth, LabelImageIsTheViewsWhereDepthWasMeasured) {
  Scene const scene = room();
  RenderedView const view = RayCaster(scene).render(truth_of(scene, FrameIndex{0}).T_world_camera);
  Grid<float> measured_m = view.depth_m;
  measured_m[0] = 0.0F;
  measured_m[1000] = 0.0F;
  LabelMap const labels = true_labels(scene, view, measured_m);
  std::vector<LabelCode> const codes = labels_of_things(scene);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_EQ(labels[i],
              measured_m[i] > 0 ? codes[static_cast<std::size_t>(view.thing[i])] : kNoDepth);
  }
}

TEST(Truth, GlassHasNoLabelAlsoWhereSomethingIsMeasured) {
  Scene scene = room();
  RenderedView const view = RayCaster(scene).render(truth_of(scene, FrameIndex{0}).T_world_camera);
  LabelMap const before = true_labels(scene, view, view.depth_m);
  scene.things[1].surface = SceneSurface::kGlass;
  LabelMap const after = true_labels(scene, view, view.depth_m);
  std::size_t of_glass = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    of_glass += view.thing[i] == 1 ? 1 : 0;
    EXPECT_EQ(after[i], view.thing[i] == 1 ? kNoDepth : before[i]);
  }
  EXPECT_GT(of_glass, 100U);
}

TEST(Truth, MoreThingsThanLabelsAreRefused) {
  Scene scene = room();
  for (std::size_t i = 0; i < kMaxWalls; ++i) {
    SceneThing wall = thing("wall " + std::to_string(i), SceneShape::kBox, {0.1, 1, 1});
    wall.kind = SceneKind::kWall;
    scene.things.push_back(wall);
  }
  EXPECT_THROW(labels_of_things(scene), InputError);
}

}  // namespace
}  // namespace credo::test
