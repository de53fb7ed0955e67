// Other proposals before the detector's own search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/detector_config.hpp"
#include "detector/bpa_detector.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "eval/true_model.hpp"
#include "proposals/fpfh_proposals.hpp"
#include "proposals/proposal_detector.hpp"
#include "sim/household.hpp"
#include "views.hpp"

namespace credo::test {
namespace {

constexpr double kJug_m = 0.22;

std::vector<ObjectModel> some_models() {
  std::vector<ObjectModel> models = household_models();
  std::erase_if(models, [](ObjectModel const& model) {
    return model.name != "jug" && model.name != "tea_box";
  });
  return models;
}

ObjectModels by_name() {
  ObjectModels named;
  for (ObjectModel const& model : some_models()) {
    named.emplace(model.name, model);
  }
  return named;
}

/// A jug alone on a table.
TableView const& jug_view() {
  static TableView const view = [] {
    TabletopScene scene;
    scene.name = "alone";
    scene.camera_m = {0.2, -0.9, 1.4};
    scene.look_at_m = {0.0, 0.0, 0.8};
    TabletopThing thing;
    thing.model = "jug";
    thing.position_m = {0.05, -0.1, kTabletopHeight_m + kJug_m / 2.0};
    thing.rpy_deg = {0.0, 0.0, 40.0};
    scene.things.push_back(thing);
    return view_of(scene, by_name(), 0);
  }();
  return view;
}

SearchModel const& jug() {
  static SearchModel const model = prepare_model(by_name().at("jug"));
  return model;
}

TEST(Proposals, WithPairsAndFacetsAllIsAsWithTheDetector) {
  BpaConfig config;
  config.search = ObjectSearch::kGlobal;
  config.min_probability = 0.01;
  BpaDetector own(by_name(), config);
  ProposalDetector same(some_models(), {.pairs = true, .facets = true}, config.min_probability);
  auto const requests = requests_for(some_models());
  std::vector<Detection> const expected = own.detect(*jug_view().frame, requests);
  std::vector<Detection> const found = same.detect(*jug_view().frame, requests);
  ASSERT_FALSE(expected.empty());
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].type, expected[i].type);
    EXPECT_EQ(found[i].score, expected[i].score);
    EXPECT_EQ(found[i].pose_camera.mean.translation(), expected[i].pose_camera.mean.translation());
    EXPECT_EQ(found[i].pose_camera.covariance, expected[i].pose_camera.covariance);
  }
}

TEST(Proposals, FpfhFindsAJug) {
  ProposalDetector detector(some_models(), {.fpfh = true}, 0.25);
  auto const found = detector.detect(*jug_view().frame, requests_for(some_models()));
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].type, "jug");
  TrueModel const truth(by_name().at("jug"));
  auto const error = truth.error(found[0].pose_camera.mean, jug_view().truths.front().pose_camera);
  EXPECT_LT(error.translation_m, kPoseTiers[2].translation_m);
  EXPECT_LT(error.rotation_rad, kPoseTiers[2].rotation_deg / 57.3);
}

TEST(Proposals, ByFpfhLayAPointOfTheModelOnOneOfTheScene) {
  FpfhSettings const settings;
  SearchScene const scene = scene_of(*jug_view().frame);
  DescribedPoints const of_model = described(jug(), settings);
  DescribedPoints const of_scene = described(scene, settings);
  ASSERT_FALSE(of_scene.points.empty());
  ASSERT_EQ(static_cast<std::size_t>(of_model.features.cols()), of_model.points.size());
  auto const proposals = propose_by_fpfh(jug(), of_model, scene, of_scene, {}, settings);
  ASSERT_FALSE(proposals.empty());
  ASSERT_LE(proposals.size(), 2 * settings.points * settings.matches);
  for (std::size_t i = 0; i < proposals.size(); i += 97) {
    CameraPose const& pose = proposals[i].pose;
    EXPECT_NEAR(pose.rotation.determinant(), 1.0F, 1e-4F);
    bool const any = std::ranges::any_of(of_scene.points, [&](BentPoint const& at) {
      return std::ranges::any_of(of_model.points, [&](BentPoint const& of) {
        return (pose * of.point - at.point).norm() < 1e-4F &&
               (pose.rotation * of.normal).dot(at.normal) > 0.999F;
      });
    });
    EXPECT_TRUE(any);
  }
}

TEST(Proposals, ByFpfhAreNoneWhereAllIsExplained) {
  FpfhSettings const settings;
  SearchScene const scene = scene_of(*jug_view().frame);
  ClaimedPixels const all(scene.pixels.width(), scene.pixels.height(), 1);
  EXPECT_TRUE(propose_by_fpfh(jug(), described(jug(), settings), scene, described(scene, settings),
                              all, settings)
                  .empty());
}

}  // namespace
}  // namespace credo::test
