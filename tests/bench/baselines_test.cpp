// Each baseline finds one thing that stands alone on a table.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "baselines/ghv_detector.hpp"
#include "baselines/icp_detector.hpp"
#include "baselines/ppf_detector.hpp"
#include "eval/true_model.hpp"
#include "sim/household.hpp"
#include "views.hpp"

namespace credo::test {
namespace {

std::vector<ObjectModel> some_models() {
  std::vector<ObjectModel> models = household_models();
  std::erase_if(models, [](ObjectModel const& model) {
    return model.name != "jug" && model.name != "water_bottle" && model.name != "tea_box";
  });
  return models;
}

TableView view_with(std::string const& model, double height_m) {
  TabletopScene scene;
  scene.name = "alone";
  scene.camera_m = {0.2, -0.9, 1.4};
  scene.look_at_m = {0.0, 0.0, 0.8};
  TabletopThing thing;
  thing.model = model;
  thing.position_m = {0.05, -0.1, kTabletopHeight_m + height_m / 2.0};
  thing.rpy_deg = {0.0, 0.0, 40.0};
  scene.things.push_back(thing);
  ObjectModels named;
  for (ObjectModel const& one : some_models()) {
    named.emplace(one.name, one);
  }
  return view_of(scene, named, 0);
}

/// The best detection is of the thing that is there, and within the middle tier.
void expect_found(Detector& detector, std::string const& name, double height_m) {
  TableView const view = view_with(name, height_m);
  std::vector<Detection> const found = detector.detect(*view.frame, requests_for(some_models()));
  ASSERT_FALSE(found.empty());
  auto const best = std::ranges::max_element(found, {}, &Detection::score);
  ASSERT_EQ(best->type, name);
  auto const models = some_models();
  TrueModel const truth(*std::ranges::find(models, name, &ObjectModel::name));
  auto const error = truth.error(best->pose_camera.mean, view.truths.front().pose_camera);
  EXPECT_LT(error.translation_m, kPoseTiers[1].translation_m);
  EXPECT_LT(error.rotation_rad, kPoseTiers[1].rotation_deg / 57.3);
}

constexpr double kJug_m = 0.22;
constexpr double kWaterBottle_m = 0.225;

TEST(Baselines, IcpFindsAJug) {
  IcpDetector detector(some_models());
  expect_found(detector, "jug", kJug_m);
}

TEST(Baselines, PpfFindsAJug) {
  PpfDetector detector(some_models());
  expect_found(detector, "jug", kJug_m);
}

TEST(Baselines, GhvIsRightIfItTellsABottle) {
  // PCL's verification decides differently from process to process: it may tell nothing.
  GhvDetector detector(some_models());
  TableView const view = view_with("water_bottle", kWaterBottle_m);
  auto const found = detector.detect(*view.frame, requests_for(some_models()));
  auto const bottle = std::ranges::find(found, "water_bottle", &Detection::type);
  if (bottle != found.end()) {
    auto const models = some_models();
    TrueModel const truth(*std::ranges::find(models, "water_bottle", &ObjectModel::name));
    EXPECT_LT(truth.error(bottle->pose_camera.mean, view.truths.front().pose_camera).translation_m,
              kPoseTiers[0].translation_m);
  }
}

TEST(Baselines, OnlyWhatIsAskedForIsTold) {
  IcpDetector detector(some_models());
  TableView const view = view_with("jug", kJug_m);
  std::vector<DetectionRequest> requests = requests_for(some_models());
  std::erase_if(requests, [](DetectionRequest const& one) { return one.type == "jug"; });
  for (Detection const& detection : detector.detect(*view.frame, requests)) {
    EXPECT_NE(detection.type, "jug");
  }
  EXPECT_TRUE(detector.detect(*view.frame, {}).empty());
}

}  // namespace
}  // namespace credo::test
