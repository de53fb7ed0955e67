#include "detector/poses/pose_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "detector/poses/verification.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

TEST(PoseScore, BehindTheCameraIsTheWorst) {
  BracketView const view = bracket_on_desk(0.3);
  PoseScore const score(prepared_bracket(), view.scene);
  CameraPose pose = view.truth;
  pose.translation_m = {0, 0, -1};
  EXPECT_EQ(score(pose, 100), PoseScore::kWorst);
  pose.translation_m = {0, 0, 0};
  EXPECT_EQ(score(pose, 100), PoseScore::kWorst);
}

TEST(PoseScore, OutsideOfTheImageNothingIsGained) {
  BracketView const view = bracket_on_desk(0.3);
  CameraPose pose = view.truth;
  pose.translation_m.x() += 5.0F;
  EXPECT_LE(PoseScore(prepared_bracket(), view.scene)(pose, 100), 0.0F);
}

TEST(PoseScore, WhatTheSceneIsSeenThroughIsWorseThanWhatIsHidden) {
  BracketView const view = bracket_on_desk(0.3);
  PoseScore const score(prepared_bracket(), view.scene);
  CameraPose before = view.truth;
  before.translation_m *= 0.8F;
  SearchScene wall = view.scene;
  wall.planes.clear();
  for (ScenePixel& pixel : wall.pixels) {
    pixel = ScenePixel{0.4F, {0, 0, -127}, kNoPlane, 1};
  }
  float const hidden = PoseScore(prepared_bracket(), wall)(view.truth, 400);
  EXPECT_LT(score(before, 400), hidden);
  EXPECT_LT(hidden, score(view.truth, 400));
}

// Among thousands of rough proposals the right one for a thing that is not found yet came after
// those that lie on what is known.
TEST(PoseScore, WhatOthersExplainComesAfterWhatIsRoughlyRight) {
  std::vector<Placed> things = desk_and_floor();
  std::vector<CameraPose> truths;
  for (double const x_m : {-0.15, 0.15}) {
    Se3 const T_world_bracket = placed_at({x_m, 0, 0}, 0.3);
    things.push_back({bracket(), T_world_bracket});
    truths.push_back(camera_pose(before_desk().inverse() * T_world_bracket));
  }
  SearchScene const scene = scene_of(*frame_of(things, before_desk()));
  SearchModel const& model = prepared_bracket();
  ClaimedPixels explained(scene.pixels.width(), scene.pixels.height(), 0);
  for (std::uint32_t const pixel : verified(model, scene, truths[0], {}).explained_px) {
    explained[pixel] = 1;
  }
  CameraPose const rough = perturbed(model, truths[1], {0.02F, 0, 0}, Vector3f::Zero());
  PoseScore const alone(model, scene);
  PoseScore const beside(model, scene, explained);
  EXPECT_GT(alone.rough(truths[0], 40), alone.rough(rough, 40));
  EXPECT_LT(beside.rough(truths[0], 40), beside.rough(rough, 40));
  EXPECT_LT(beside(truths[0], 400), 0.0F);
  // Elsewhere, and where nothing is explained, all is as before.
  EXPECT_EQ(beside(truths[1], 400), alone(truths[1], 400));
  EXPECT_EQ(PoseScore(model, scene, {})(truths[0], 400), alone(truths[0], 400));
}

// A piece of a large flat surface looks like one side of a box; its silhouette does not.
TEST(PoseScore, APieceWithinASurfaceIsWorseThanAFaceOfItsSize) {
  ObjectModel const box = crate({0.15, 0.15, 0.10});
  SearchModel const model = prepare_model(box);
  auto const score_before = [&](Eigen::Vector3d const& size_m) {
    // Its face is 0.8 m away, that of the model lies in it.
    Se3 const T_camera_box(
        Eigen::Quaterniond(Eigen::AngleAxisd(-std::acos(-1.0) / 2, Eigen::Vector3d::UnitX())),
        {0, size_m.z() / 2, 0.8 + size_m.y() / 2});
    SearchScene const scene = scene_of(*frame_of({{crate(size_m), T_camera_box}}, {}));
    Se3 const T_camera_model(T_camera_box.rotation(), {0, 0.05, 0.8 + 0.075});
    return PoseScore(model, scene)(camera_pose(T_camera_model), 400);
  };
  EXPECT_GT(score_before({0.15, 0.15, 0.10}), score_before({0.20, 0.15, 0.16}) + 0.1F);
}

/// The score of the truth in a scene with one change to each of its pixels.
template <typename Change>
float score_after(BracketView const& view, Change const& change) {
  SearchScene scene = view.scene;
  for (ScenePixel& pixel : scene.pixels) {
    change(pixel);
  }
  return PoseScore(prepared_bracket(), scene)(view.truth, 400);
}

TEST(PoseScore, ALargePlaneBeforeItDoesNotHideIt) {
  BracketView const view = bracket_on_desk(0.3);
  auto const before = [&](std::uint8_t plane) {
    return score_after(view, [&](ScenePixel& pixel) {
      pixel.depth_m = 0.5F;
      pixel.plane = plane;
    });
  };
  EXPECT_LT(before(0), before(kNoPlane) - 0.2F);
}

TEST(PoseScore, NormalsThatDisagreeCountLess) {
  BracketView const view = bracket_on_desk(0.3);
  float const agreeing = score_after(view, [](ScenePixel&) {});
  EXPECT_LT(score_after(view,
                        [](ScenePixel& pixel) {
                          pixel.normal = {0, 0, 127};
                        }),
            agreeing - 0.2F);
}

TEST(PoseScore, ASurfaceThatGoesOnBeyondTheSilhouetteCountsLess) {
  SearchModel const plate = prepare_model(
      {"plate", std::vector<Solid>{BoxSolid{{-0.05, -0.05, 0.0}, {0.05, 0.05, 0.002}}}, {}});
  CameraPose const pose = camera_pose(Se3(Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 0.8}));
  SearchScene scene;
  scene.pixels = Grid<ScenePixel>(640, 480, ScenePixel{0.798F, {0, 0, -127}, kNoPlane, 1});
  scene.segments.assign(2, SceneSegment{10000, {0.0F, 0.0F, 0.8F}, 0.1F, 0.01F});
  float const goes_on = PoseScore(plate, scene)(pose, 400);
  DepthPatch const patch = plate.rendered(pose, scene.intrinsics, scene.size());
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    Pixel const p = scene.pixels.pixel(i);
    Pixel const in_patch{p.u - patch.corner.u, p.v - patch.corner.v};
    scene.pixels[i].segment = patch.depth_m.contains(in_patch) ? 1 : 2;
  }
  EXPECT_GT(PoseScore(plate, scene)(pose, 400), goes_on + 0.1F);
}

}  // namespace
}  // namespace credo::test
