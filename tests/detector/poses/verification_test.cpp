#include "detector/poses/verification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "detector/poses/pose_score.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

/// Poses that are far enough off to be wrong, near enough to fit in part.
std::vector<CameraPose> wrong_poses(CameraPose const& truth, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> number;
  auto const direction = [&] {
    return Vector3f(number(random), number(random), number(random)).normalized();
  };
  std::vector<CameraPose> poses;
  for (int i = 0; i < 15; ++i) {
    poses.push_back(perturbed(prepared_bracket(), truth, 0.03F * direction(), Vector3f::Zero()));
    poses.push_back(perturbed(prepared_bracket(), truth, Vector3f::Zero(), 0.6F * direction()));
  }
  return poses;
}

class BracketOnDesk : public ::testing::TestWithParam<double> {};

TEST_P(BracketOnDesk, TheTruthScoresBest) {
  BracketView const view = bracket_on_desk(GetParam(), {SensorModel::kGaussian});
  PoseScore const score(prepared_bracket(), view.scene);
  Verification const right = verified(prepared_bracket(), view.scene, view.truth, {});
  EXPECT_GT(right.log_odds, 0.0F);
  for (std::size_t const points : {std::size_t{100}, std::size_t{800}}) {
    float const best = score(view.truth, points);
    EXPECT_LE(best, 1.0F);
    for (CameraPose const& wrong : wrong_poses(view.truth, 1)) {
      EXPECT_GT(best, score(wrong, points));
    }
  }
  for (CameraPose const& wrong : wrong_poses(view.truth, 2)) {
    EXPECT_GT(right.log_odds, verified(prepared_bracket(), view.scene, wrong, {}).log_odds);
  }
}

INSTANTIATE_TEST_SUITE_P(Yaws, BracketOnDesk, ::testing::Values(0.3, 2.2, 4.4));

int rendered_px(SearchModel const& model, SearchScene const& scene, CameraPose const& pose) {
  DepthPatch const patch = model.rendered(pose, scene.intrinsics, scene.size());
  return static_cast<int>(
      std::ranges::count_if(patch.depth_m, [](float depth_m) { return depth_m < kNoSurface_m; }));
}

TEST(Verification, CountsAddUpToWhatIsRendered) {
  BracketView const view = bracket_on_desk(0.3, {SensorModel::kDisparity});
  std::vector<CameraPose> poses = wrong_poses(view.truth, 3);
  poses.push_back(view.truth);
  for (CameraPose const& pose : poses) {
    Verification const v = verified(prepared_bracket(), view.scene, pose, {});
    EXPECT_EQ(v.shown_px(), rendered_px(prepared_bracket(), view.scene, pose));
    EXPECT_EQ(v.explained_px.size(), static_cast<std::size_t>(v.in_px));
    EXPECT_TRUE(std::ranges::is_sorted(v.explained_px));
    EXPECT_FLOAT_EQ(v.visible_fraction, static_cast<float>(v.in_px + v.background_px) /
                                            static_cast<float>(v.shown_px()));
    for (float const share : {v.explained, v.outline_open, v.edges_found}) {
      EXPECT_GE(share, 0.0F);
      EXPECT_LE(share, 1.0F);
    }
  }
}

TEST(Verification, WhatIsExplainedIsTheThing) {
  BracketView const view = bracket_on_desk(0.3);
  Verification const v = verified(prepared_bracket(), view.scene, view.truth, {});
  DepthPatch const patch =
      prepared_bracket().rendered(view.truth, view.scene.intrinsics, view.scene.size());
  for (std::uint32_t const i : v.explained_px) {
    Pixel const p = view.scene.pixels.pixel(i);
    Pixel const in_patch{p.u - patch.corner.u, p.v - patch.corner.v};
    ASSERT_TRUE(patch.depth_m.contains(in_patch));
    EXPECT_NEAR(view.scene.pixels[p].depth_m, patch.depth_m[in_patch], 0.012F);
  }
  EXPECT_GT(v.in_px, v.shown_px() * 3 / 4);
  EXPECT_LT(v.block_misfit, 1.0F);
  EXPECT_GT(v.edges_found, 0.6F);
  EXPECT_GT(v.explained, 0.8F);
  EXPECT_LT(v.outline_open, 0.3F);
}

TEST(Verification, ClaimedPixelsAreHidden) {
  BracketView const view = bracket_on_desk(0.3);
  ClaimedPixels claimed(640, 480, 1);
  Verification const all = verified(prepared_bracket(), view.scene, view.truth, claimed);
  EXPECT_EQ(all.occluded_px, all.shown_px());
  EXPECT_GT(all.shown_px(), 1000);
  EXPECT_LT(all.log_odds, -5.0F);
  EXPECT_TRUE(all.explained_px.empty());
  Verification const free = verified(prepared_bracket(), view.scene, view.truth, {});
  std::ranges::fill(claimed, std::uint8_t{0});
  for (std::size_t i = 0; i < free.explained_px.size(); i += 2) {
    claimed[free.explained_px[i]] = 1;
  }
  Verification const half = verified(prepared_bracket(), view.scene, view.truth, claimed);
  EXPECT_EQ(half.shown_px(), free.shown_px());
  EXPECT_EQ(half.in_px, free.in_px / 2);
  EXPECT_EQ(half.occluded_px - free.occluded_px, free.in_px - half.in_px);
  EXPECT_LT(half.visible_fraction, free.visible_fraction);
}

/// The scene with one change to each of its pixels.
template <typename Change>
Verification verified_after(BracketView const& view, Change const& change) {
  SearchScene scene = view.scene;
  for (ScenePixel& pixel : scene.pixels) {
    change(pixel);
  }
  return verified(prepared_bracket(), scene, view.truth, {});
}

TEST(Verification, WhatStandsBeforeItHidesIt) {
  Verification const v = verified_after(bracket_on_desk(0.3), [](ScenePixel& pixel) {
    pixel.depth_m = 0.5F;
    pixel.plane = kNoPlane;
  });
  EXPECT_EQ(v.occluded_px, v.shown_px());
  EXPECT_LT(v.log_odds, -5.0F);
}

TEST(Verification, WhatIsBehindItIsSeenThroughIt) {
  Verification const v = verified_after(bracket_on_desk(0.3), [](ScenePixel& pixel) {
    pixel.depth_m = 2.0F;
    pixel.plane = kNoPlane;
  });
  EXPECT_EQ(v.seen_through_px, v.shown_px());
  EXPECT_LT(v.log_odds, -5.0F);
}

TEST(Verification, WithoutDepthNothingIsKnown) {
  Verification const v =
      verified_after(bracket_on_desk(0.3), [](ScenePixel& pixel) { pixel = {}; });
  EXPECT_EQ(v.no_depth_px, v.shown_px());
  EXPECT_EQ(v.visible_fraction, 0.0F);
  EXPECT_LT(v.log_odds, -5.0F);
}

TEST(Verification, ALargePlaneIsNoEvidence) {
  BracketView const view = bracket_on_desk(0.3);
  ASSERT_FALSE(view.scene.planes.empty());
  Verification const before = verified(prepared_bracket(), view.scene, view.truth, {});
  Verification const v = verified_after(view, [](ScenePixel& pixel) { pixel.plane = 0; });
  EXPECT_EQ(v.in_px, 0);
  EXPECT_EQ(v.background_px, before.in_px + before.background_px);
  EXPECT_LT(v.log_odds, -5.0F);
  // One that stands nearer cannot hide it: the thing would be within or behind it.
  Verification const under = verified_after(view, [](ScenePixel& pixel) {
    pixel.plane = 0;
    pixel.depth_m = 0.5F;
  });
  EXPECT_EQ(under.behind_plane_px, under.shown_px());
  EXPECT_EQ(under.sunk_px, 0) << "nothing of it is before the plane";
}

// A crate 10 cm high on the desk, and one 18 cm high whose top would be at the same place.
TEST(Verification, NothingIsSunkIntoADesk) {
  ObjectModel const low = crate({0.16, 0.12, 0.10});
  std::vector<Placed> things = desk_and_floor();
  things.push_back({low, placed_at({0, 0, 0}, 0.5)});
  FramePtr const frame = frame_of(things, before_desk(), {SensorModel::kGaussian});
  SearchScene const scene = scene_of(*frame);
  auto const pose_at = [](double z_m) {
    return camera_pose(before_desk().inverse() * placed_at({0, 0, z_m}, 0.5));
  };
  Verification const right = verified(prepare_model(low), scene, pose_at(0.0), {});
  EXPECT_EQ(right.sunk_px, 0);
  SearchModel const high = prepare_model(crate({0.16, 0.12, 0.18}));
  Verification const sunk = verified(high, scene, pose_at(-0.08), {});
  EXPECT_GT(sunk.sunk_px, sunk.shown_px() / 5);
  EXPECT_EQ(sunk.sunk_px, sunk.behind_plane_px);
  EXPECT_LT(sunk.log_odds, right.log_odds - 3.0F);
}

TEST(Verification, WhatIsPartlyBehindAScreenIsNotSunkIntoIt) {
  BracketView view = bracket_alone(Eigen::Quaterniond::Identity());
  Vector3f const centre = view.truth * prepared_bracket().centre_model;
  int const middle_px = static_cast<int>(std::lround(525.0F * centre.x() / centre.z() + 319.5F));
  view.scene.planes = {{-Vector3f::UnitZ(), -0.5F, 2.0F, 1}};
  for (int v = 0; v < view.scene.pixels.height(); ++v) {
    for (int u = 0; u < middle_px; ++u) {
      view.scene.pixels[{u, v}].depth_m = 0.5F;
      view.scene.pixels[{u, v}].plane = 0;
    }
  }
  Verification const v = verified(prepared_bracket(), view.scene, view.truth, {});
  EXPECT_GT(v.in_px, 0);
  EXPECT_GT(v.behind_plane_px, 0);
  EXPECT_EQ(v.sunk_px, 0);
}

TEST(Verification, ReliefTellsOfShapesAndNotOfPlanes) {
  ObjectModel const plate{
      "plate", std::vector<Solid>{BoxSolid{{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.002}}}, {}};
  // At a slant, where depths differ by far more than they stray.
  Se3 const pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitX())), {0, 0, 0.9});
  SearchScene const flat = scene_of(*frame_of({{plate, pose}}, {}, {SensorModel::kGaussian}));
  Verification const of_plate = verified(prepare_model(plate), flat, camera_pose(pose), {});
  EXPECT_GT(of_plate.in_px + of_plate.background_px, 1000);
  EXPECT_LT(of_plate.relief, 0.1F);
  BracketView const view = bracket_on_desk(0.3, {SensorModel::kGaussian});
  Verification const right = verified(prepared_bracket(), view.scene, view.truth, {});
  EXPECT_GT(right.relief, 1.0F);
  CameraPose const turned =
      perturbed(prepared_bracket(), view.truth, Vector3f::Zero(), Vector3f(0.0F, 0.0F, 0.5F));
  EXPECT_LT(verified(prepared_bracket(), view.scene, turned, {}).relief, right.relief - 0.3F);
}

// A plate before nothing, and in the midst of a surface that goes on around it.
TEST(Verification, TellsHowMuchOfASurfaceItExplains) {
  SearchModel const plate = prepare_model(
      {"plate", std::vector<Solid>{BoxSolid{{-0.05, -0.05, 0.0}, {0.05, 0.05, 0.002}}}, {}});
  CameraPose const pose = camera_pose(Se3(Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 0.8}));
  SearchScene scene;
  scene.pixels = Grid<ScenePixel>(640, 480, ScenePixel{0.798F, {0, 0, -127}, kNoPlane, 1});
  scene.segments = {SceneSegment{640 * 480, {0.0F, 0.0F, 0.8F}, 0.1F, 0.01F}};
  Verification const within = verified(plate, scene, pose, {});
  EXPECT_LT(within.explained, 0.1F);
  EXPECT_GT(within.outline_open, 0.9F);
  EXPECT_LT(within.edges_found, 0.1F);
  scene.segments[0].pixels = within.in_px;
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    if (!std::ranges::binary_search(within.explained_px, static_cast<std::uint32_t>(i))) {
      scene.pixels[i].depth_m = 2.0F;
    }
    scene.pixels[i].normal = {0, 0, 127};
  }
  Verification const alone = verified(plate, scene, pose, {});
  EXPECT_GT(alone.explained, 0.95F);
  EXPECT_LT(alone.outline_open, 0.05F);
  EXPECT_GT(alone.edges_found, 0.9F);
}

TEST(Verification, OutsideOfTheImageNothingIsShown) {
  BracketView const view = bracket_on_desk(0.3);
  CameraPose pose = view.truth;
  pose.translation_m.x() += 5.0F;
  Verification const v = verified(prepared_bracket(), view.scene, pose, {});
  EXPECT_EQ(v.shown_px(), 0);
  EXPECT_EQ(v.visible_fraction, 0.0F);
  EXPECT_LT(v.log_odds, -5.0F);
}

TEST(Verification, AHalfHiddenObjectIsLessVisibleYetLikely) {
  std::vector<Placed> things = desk_and_floor();
  Se3 const T_world_model = placed_at({0, 0, 0}, 0.3);
  things.push_back({bracket(), T_world_model});
  ObjectModel const screen{
      "screen", std::vector<Solid>{BoxSolid{{0.0, -0.01, 0.0}, {0.2, 0.01, 0.25}}}, {}};
  things.push_back({screen, placed_at({0.02, -0.25, 0})});
  SearchScene const scene = scene_of(*frame_of(things, before_desk()));
  CameraPose const truth = camera_pose(before_desk().inverse() * T_world_model);
  Verification const v = verified(prepared_bracket(), scene, truth, {});
  EXPECT_GT(v.occluded_px, v.shown_px() / 5);
  EXPECT_GT(v.in_px, v.shown_px() / 5);
  EXPECT_LT(v.seen_through_px, v.shown_px() / 20);
  EXPECT_GT(v.log_odds, 0.0F);
}

TEST(Verification, BesideOneThatExplainsMoreItIsLessLikely) {
  Verification verification;
  verification.in_px = 1000;
  verification.seen_through_px = 50;
  verification.log_odds = 2.0F;
  EXPECT_EQ(verification.net_px(), 950);
  EXPECT_EQ(log_odds_beside(verification, 0), 2.0F);
  EXPECT_EQ(log_odds_beside(verification, 900), 2.0F) << "it explains more itself";
  EXPECT_EQ(log_odds_beside(verification, 950), 2.0F);
  EXPECT_NEAR(log_odds_beside(verification, 1000), 1.0F, 1e-5F) << "a twentieth less";
  EXPECT_EQ(log_odds_beside(verification, 5000), -1.0F) << "never more than so much";
}

}  // namespace
}  // namespace credo::test
