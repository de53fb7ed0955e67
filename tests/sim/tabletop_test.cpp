#include "sim/tabletop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "sim/household.hpp"
#include "sim/scene.hpp"
#include "sim/thing.hpp"

namespace credo::test {
namespace {

TabletopScene one_scene() {
  TabletopScene scene;
  scene.name = "desk-03";
  scene.seed = 17;
  scene.camera_m = {0.1, -1.2, 1.4};
  scene.look_at_m = {0, 0, 0.8};
  scene.wall_y_m = 0.9;
  scene.things.push_back({"mug", SceneShape::kBox, {}, {0.1, -0.05, 0.7875}, {0, 0, 30.25}});
  scene.things.push_back({"", SceneShape::kCylinder, {0.03, 0.12}, {-0.2, 0, 0.74}, {0, 90, -7.5}});
  return scene;
}

std::string refusal(std::string const& text) {
  try {
    static_cast<void>(scenes_in(text, "file.txt"));
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

TEST(Tabletop, TextComesBackAsItWas) {
  std::string const text = text_of({one_scene(), one_scene()});
  std::vector<TabletopScene> const read = scenes_in(text, "memory");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(text_of(read), text);
  TabletopScene const& scene = read.back();
  EXPECT_EQ(scene.name, "desk-03");
  EXPECT_EQ(scene.seed, 17);
  EXPECT_EQ(scene.camera_m, one_scene().camera_m);
  EXPECT_EQ(scene.look_at_m, one_scene().look_at_m);
  EXPECT_EQ(scene.wall_y_m, 0.9);
  ASSERT_EQ(scene.things.size(), 2U);
  EXPECT_EQ(scene.things[0].model, "mug");
  EXPECT_EQ(scene.things[0].rpy_deg, Eigen::Vector3d(0, 0, 30.25));
  EXPECT_EQ(scene.things[1].shape, SceneShape::kCylinder);
  EXPECT_EQ(scene.things[1].size_m, (std::vector<double>{0.03, 0.12}));
  EXPECT_EQ(scene.things[1].position_m, Eigen::Vector3d(-0.2, 0, 0.74));
}

TEST(Tabletop, SaysWhichLineIsWrong) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("object mug 0 0 0 0 0 0\n"), HasSubstr("file.txt:1: a scene must come"));
  EXPECT_THAT(refusal("scene a 1\nobject mug 0 0 0 0 0\n"), HasSubstr("file.txt:2: not the num"));
  EXPECT_THAT(refusal("scene a 1\nobject mug 0 0 0 0 0 0 7\n"), HasSubstr("file.txt:2: not the"));
  EXPECT_THAT(refusal("scene a 1\n\nlamp 1\n"), HasSubstr("file.txt:3: unknown word 'lamp'"));
  EXPECT_THAT(refusal("scene a 1\nunknown cone 1\n"), HasSubstr("unknown shape 'cone'"));
}

TEST(Tabletop, BecomesASceneWithTableFloorAndWall) {
  ObjectModels models;
  for (ObjectModel const& model : household_models()) {
    models.emplace(model.name, model);
  }
  Scene const scene = scene_of(one_scene(), models);
  EXPECT_NO_THROW(check_scene(scene));
  ASSERT_EQ(scene.things.size(), 5U);
  EXPECT_EQ(scene.things[3].kind, SceneKind::kObject);
  EXPECT_EQ(type_of(scene.things[3]), "mug");
  EXPECT_EQ(pose_of(scene.things[3]).translation(), Eigen::Vector3d(0.1, -0.05, 0.7875));
  EXPECT_EQ(scene.things[4].kind, SceneKind::kStuff);
  EXPECT_EQ(scene.camera.sensor, SensorModel::kDisparity);
  models.erase("mug");
  EXPECT_THROW(static_cast<void>(scene_of(one_scene(), models)), InputError);
}

}  // namespace
}  // namespace credo::test
