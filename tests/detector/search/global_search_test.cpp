#include "detector/search/global_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "detector/detection_picture.hpp"
#include "detector/poses/pose_distance.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/search/pair_proposals.hpp"
#include "detector/views.hpp"
#include "sim/household.hpp"

namespace credo::test {
namespace {

PairTable const& bracket_pairs() {
  static PairTable const pairs(prepared_bracket());
  return pairs;
}

class BracketAnywhere : public ::testing::TestWithParam<double> {};

TEST_P(BracketAnywhere, IsFoundFirst) {
  SearchModel const& model = prepared_bracket();
  BracketView const view = bracket_on_desk(GetParam(), {SensorModel::kGaussian});
  std::vector<PoseCandidate> const found = search_everywhere(model, bracket_pairs(), view.scene, 5);
  ASSERT_FALSE(found.empty());
  EXPECT_LE(found.size(), 5U);
  EXPECT_LT(mean_distance_m(model, found[0].pose, view.truth), 0.1 * model.diameter_m);
  EXPECT_GT(found[0].verification.log_odds, 0.0F);
  PoseDistance const distance(model);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(found[j].verification.log_odds, found[i].verification.log_odds);
      EXPECT_GT(distance(found[i].pose, found[j].pose), 0.03F * model.diameter_m);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Yaws, BracketAnywhere, ::testing::Values(0.3, 2.2, 4.4));

TEST(GlobalSearch, WhatIsNotThereIsUnlikely) {
  FramePtr const bare = frame_of(desk_and_floor(), before_desk());
  for (PoseCandidate const& candidate :
       search_everywhere(prepared_bracket(), bracket_pairs(), scene_of(*bare), 5)) {
    EXPECT_LT(candidate.verification.log_odds, 0.0F);
  }
  Frame blind;
  blind.cloud_camera = cloud_from_depth(Grid<float>(640, 480, 0.0F), blind.intrinsics);
  EXPECT_TRUE(search_everywhere(prepared_bracket(), bracket_pairs(), scene_of(blind), 5).empty());
}

TEST(GlobalSearch, ACrateAndACanAreFound) {
  std::vector<Placed> things = desk_and_floor();
  Eigen::Vector3d const size_m(0.22, 0.14, 0.10);
  Se3 const T_world_crate = placed_at({-0.2, 0, 0}, 0.6);
  Se3 const T_world_can = placed_at({0.15, 0.05, 0}, 0.0);
  things.push_back({crate(size_m), T_world_crate});
  things.push_back({can(0.04, 0.13), T_world_can});
  SearchScene const scene = scene_of(*frame_of(things, before_desk()));
  auto const expect_found = [&](ObjectModel const& object, Se3 const& T_world_object) {
    SearchModel const model = prepare_model(object);
    std::vector<PoseCandidate> const found = search_everywhere(model, PairTable(model), scene, 1);
    ASSERT_EQ(found.size(), 1U);
    CameraPose const truth = camera_pose(before_desk().inverse() * T_world_object);
    // Upside down is the same where the model does not say so: the centre tells.
    EXPECT_LT((found[0].pose * model.centre_model - truth * model.centre_model).norm(),
              0.1F * model.diameter_m)
        << object.name;
    EXPECT_GT(found[0].verification.log_odds, 0.0F) << object.name;
  };
  expect_found(crate(size_m), T_world_crate);
  expect_found(can(0.04, 0.13), T_world_can);
}

TEST(GlobalSearch, IsFoundAmongThingsThatComeBefore) {
  // The segments of the others come first, with more proposals than are looked at closely.
  std::vector<Placed> things = desk_and_floor();
  for (int i = 0; i < 12; ++i) {
    double const x_m = -0.35 + 0.14 * (i % 6);
    double const y_m = 0.12 + 0.16 * (i / 6);
    things.push_back(
        i % 2 == 0 ? Placed{crate({0.09, 0.08, 0.07 + 0.005 * i}), placed_at({x_m, y_m, 0}, i)}
                   : Placed{can(0.035, 0.09), placed_at({x_m, y_m, 0})});
  }
  Se3 const T_world_bracket = placed_at({0.1, -0.15, 0.0}, 0.8);
  things.push_back({bracket(), T_world_bracket});
  SearchScene const scene = scene_of(*frame_of(things, before_desk(), {SensorModel::kGaussian}));
  SearchModel const& model = prepared_bracket();
  std::vector<Proposal> const proposals = propose_by_pairs(model, bracket_pairs(), scene, {});
  CameraPose const truth = camera_pose(before_desk().inverse() * T_world_bracket);
  auto const near = [&](Proposal const& proposal) {
    return mean_distance_m(model, proposal.pose, truth) < 0.15 * model.diameter_m;
  };
  ASSERT_TRUE(std::none_of(proposals.begin(), proposals.begin() + 600, near));
  std::vector<PoseCandidate> const found = search_everywhere(model, bracket_pairs(), scene, 5);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(mean_distance_m(model, found[0].pose, truth), 0.1 * model.diameter_m);
}

TEST(GlobalSearch, ASecondLookLooksAtWhatIsNotExplained) {
  std::vector<Placed> things = desk_and_floor();
  std::vector<CameraPose> truths;
  for (double const x : {-0.15, 0.15}) {
    Se3 const T_world_bracket = placed_at({x, 0, 0}, 0.3);
    things.push_back({bracket(), T_world_bracket});
    truths.push_back(camera_pose(before_desk().inverse() * T_world_bracket));
  }
  SearchScene const scene = scene_of(*frame_of(things, before_desk(), {SensorModel::kGaussian}));
  SearchModel const& model = prepared_bracket();
  auto const is_at = [&](PoseCandidate const& candidate, CameraPose const& truth) {
    return mean_distance_m(model, candidate.pose, truth) < 0.1 * model.diameter_m;
  };
  for (CameraPose const& known : truths) {
    CameraPose const& other = truths[&known == &truths[0] ? 1 : 0];
    ClaimedPixels explained(scene.pixels.width(), scene.pixels.height(), 0);
    PoseCandidate const before{known, verified(model, scene, known, {})};
    for (std::uint32_t const pixel : before.verification.explained_px) {
      explained[pixel] = 1;
    }
    auto const only = search_everywhere(model, bracket_pairs(), scene, 1, explained);
    ASSERT_EQ(only.size(), 1U);
    EXPECT_TRUE(is_at(only[0], other));
    auto const both = search_again(model, bracket_pairs(), scene, {before}, explained, 1);
    ASSERT_EQ(both.size(), 2U) << "what was found before stays";
    EXPECT_TRUE(std::ranges::any_of(both, [&](auto const& c) { return is_at(c, known); }));
    EXPECT_TRUE(std::ranges::any_of(both, [&](auto const& c) { return is_at(c, other); }));
    EXPECT_GE(both[0].verification.log_odds, both[1].verification.log_odds);
  }
}

class MugAnywhere : public ::testing::TestWithParam<double> {};

TEST_P(MugAnywhere, ItsHandleIsFoundToo) {
  std::vector<ObjectModel> const household = household_models();
  ObjectModel const mug = *std::ranges::find(household, "mug", &ObjectModel::name);
  std::vector<Placed> things = desk_and_floor();
  Se3 const T_world_mug = placed_at({0.0, 0.0, 0.0475}, GetParam());
  things.push_back({mug, T_world_mug});
  SearchScene const scene = scene_of(*frame_of(things, before_desk(), {SensorModel::kDisparity}));
  SearchModel const model = prepare_model(mug);
  std::vector<PoseCandidate> const found = search_everywhere(model, PairTable(model), scene, 5);
  ASSERT_FALSE(found.empty());
  Vector6d const error = boxminus(before_desk().inverse() * T_world_mug, se3(found[0].pose));
  EXPECT_LT(error.head<3>().norm(), 0.005);
  EXPECT_LT(error.tail<3>().norm(), 0.15);
}

// Turned so that the handle shows from before the desk.
INSTANTIATE_TEST_SUITE_P(Yaws, MugAnywhere, ::testing::Values(-2.8, -2.2, -1.6, -0.9, -0.3, 0.2));

class Picture : public ::testing::Test {
protected:
  static Detection detection(Se3 const& pose, std::string const& type) {
    Detection detection;
    detection.type = type;
    detection.pose_camera.mean = pose;
    return detection;
  }
  static std::vector<Pixel> changed(Grid<Rgb> const& a, Grid<Rgb> const& b) {
    std::vector<Pixel> pixels;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] != b[i]) {
        pixels.push_back(a.pixel(i));
      }
    }
    return pixels;
  }

  BracketView view_ = bracket_on_desk(0.3);
  PreparedModels models_ = {{"bracket", std::make_shared<PreparedModel const>(
                                            PreparedModel{prepared_bracket(), PairTable()})}};
};

TEST_F(Picture, ShowsAModelWhereItIs) {
  Grid<Rgb> const without = draw_detections(*view_.frame, models_, {});
  Grid<Rgb> const with =
      draw_detections(*view_.frame, models_, {detection(view_.T_camera_model, "bracket")});
  ASSERT_EQ(without.width(), 640);
  DepthPatch const patch =
      prepared_bracket().rendered(view_.truth, view_.frame->intrinsics, {640, 480});
  std::vector<Pixel> const pixels = changed(without, with);
  EXPECT_GT(pixels.size(), 1000U);
  for (Pixel const& p : pixels) {
    Pixel const in_patch{p.u - patch.corner.u, p.v - patch.corner.v};
    ASSERT_TRUE(patch.depth_m.contains(in_patch));
    EXPECT_LT(patch.depth_m[in_patch], kNoSurface_m);
  }
}

TEST_F(Picture, WhatIsHiddenHasItsSilhouetteOnly) {
  Se3 const under(view_.T_camera_model.rotation(), 1.3 * view_.T_camera_model.translation());
  Grid<Rgb> const without = draw_detections(*view_.frame, models_, {});
  auto const hidden =
      changed(without, draw_detections(*view_.frame, models_, {detection(under, "bracket")}));
  DepthPatch const patch =
      prepared_bracket().rendered(camera_pose(under), view_.frame->intrinsics, {640, 480});
  auto const shown = static_cast<std::size_t>(
      std::ranges::count_if(patch.depth_m, [](float depth_m) { return depth_m < kNoSurface_m; }));
  EXPECT_GT(hidden.size(), 50U);
  EXPECT_LT(hidden.size(), shown / 2);
}

TEST_F(Picture, TypesWithoutAModelAreLeftOut) {
  Grid<Rgb> const without = draw_detections(*view_.frame, models_, {});
  EXPECT_EQ(draw_detections(*view_.frame, models_, {detection(view_.T_camera_model, "ghost")}),
            without);
}

TEST_F(Picture, IsInColourWhereThatIsRegistered) {
  Frame frame = *view_.frame;
  frame.color = Grid<Rgb>(640, 480, Rgb{10, 200, 30});
  EXPECT_NE(draw_detections(frame, models_, {}), frame.color);
  frame.color_registered = true;
  EXPECT_EQ(draw_detections(frame, models_, {}), frame.color);
}

TEST_F(Picture, OfNothingIsEmpty) {
  EXPECT_TRUE(
      draw_detections(Frame{}, models_, {detection(view_.T_camera_model, "bracket")}).empty());
}

}  // namespace
}  // namespace credo::test
