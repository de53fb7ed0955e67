#include "stages/fusion/objects/looks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "stages/fusion/stuff/table_views.hpp"

namespace credo {
namespace {

using test::Board;
using test::View;

constexpr LabelCode kBoard = kFirstObject;

/// A box of 20 x 20 x 10 cm whose front fits the board {left 0, top 0, z 1.5}.
KnownSurface const& box() {
  static KnownSurface const surface =
      known_surfaces(
          {{"box", {"box", std::vector<Solid>{BoxSolid{{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.1}}}, {}}}})
          .at("box");
  return surface;
}

PoseDistribution at(double x_m, double z_m, double sigma_m) {
  PoseDistribution pose;
  pose.mean = Se3(Eigen::Quaterniond::Identity(), {x_m, 0.1, z_m});
  pose.covariance = Matrix6d::Identity() * sigma_m * sigma_m;
  return pose;
}

ObjectLook look(View const& view, PoseDistribution const& pose, FusionConfig const& config = {}) {
  Segmentation const frame = test::segmentation_of(view);
  return ObjectLooks(frame.sight, frame.T_world_camera, config).look_at(pose, box());
}

int total(PointCounts const& counts) {
  int sum = 0;
  for (int const count : counts.by_state) {
    sum += count;
  }
  return sum;
}

TEST(ObjectLooks, OnlyWhatFacesTheCameraIsLookedFor) {
  FusionConfig config;
  config.objects.surely_found_px = 300.0;
  ObjectLook const seen = look({.boards = {{kBoard}}}, at(0.1, 1.5, 1e-4), config);
  // The front is 400 of the 1600 square centimetres.
  auto const points = static_cast<double>(box().points_model.size());
  EXPECT_NEAR(total(seen.points), points / 4, points / 10);
  EXPECT_GT(seen.points[PointState::kAgrees], 0.9 * total(seen.points));
  EXPECT_GT(seen.visible_share, 0.8);
  EXPECT_NEAR(seen.found_if_there, FusionConfig{}.existence.seen_if_present, 1e-12);
  EXPECT_GT(seen.missed_if_there, 0.9) << "a detector that erred";
  EXPECT_LE(seen.missed_if_there, 1.0);
}

TEST(ObjectLooks, WhatIsGoneIsSeenThrough) {
  ObjectLook const seen = look({}, at(0.1, 1.5, 1e-4));
  EXPECT_EQ(seen.points[PointState::kSeenThrough], total(seen.points));
  EXPECT_EQ(seen.visible_share, 1.0);
  EXPECT_LT(seen.missed_if_there, 0.01) << "neither found nor there";
}

TEST(ObjectLooks, OfWhatIsHiddenNothingIsTold) {
  Board const in_front{std::nullopt, -0.5, -0.5, 1.0, 1.0, 1.0};
  for (double const sigma_m : {1e-4, 0.02}) {
    ObjectLook const seen = look({.boards = {{kBoard}, in_front}}, at(0.1, 1.5, sigma_m));
    EXPECT_EQ(seen.points[PointState::kOccluded], total(seen.points));
    EXPECT_EQ(seen.visible_share, 0.0);
    EXPECT_EQ(seen.found_if_there, 0.0);
    EXPECT_EQ(seen.missed_if_there, 1.0) << "to the bit";
  }
}

TEST(ObjectLooks, OfWhatIsOutOfViewNothingIsTold) {
  for (double const x_m : {5.0, -5.0}) {
    ObjectLook const seen = look({}, at(x_m, 1.5, 0.02));
    EXPECT_GT(seen.points[PointState::kOutOfView], 0);
    EXPECT_EQ(seen.points[PointState::kOutOfView], total(seen.points));
    EXPECT_EQ(seen.missed_if_there, 1.0);
  }
  EXPECT_EQ(look({}, at(0.1, -1.5, 0.02)).missed_if_there, 1.0) << "behind the camera";
}

TEST(ObjectLooks, WhereNothingIsMeasuredNothingIsTold) {
  ObjectLook const seen = look({.boards = {{kBoard}}, .blind_px = 160}, at(0.1, 1.5, 1e-4));
  EXPECT_EQ(seen.points[PointState::kUnmeasured], total(seen.points));
  EXPECT_EQ(seen.missed_if_there, 1.0);
}

// 160 pixels at 1.5 m reach 80 cm to the right: half of the box is beyond.
TEST(ObjectLooks, WhatReachesOutOfViewIsPartlyVisible) {
  ObjectLook const seen = look({.boards = {{kBoard, 0.7}}}, at(0.8, 1.5, 1e-4));
  EXPECT_NEAR(seen.visible_share, 0.5, 0.1);
}

// Hidden where the mean is, but not everywhere where it may be.
TEST(ObjectLooks, WhereItMayBeCountsAndNotOnlyTheMean) {
  Board const in_front{std::nullopt, -0.02, -0.5, 0.24, 1.0, 1.4};
  View const view{.boards = {in_front}};
  EXPECT_EQ(look(view, at(0.1, 1.5, 1e-4)).missed_if_there, 1.0);
  ObjectLook const vague = look(view, at(0.1, 1.5, 0.2));
  EXPECT_LT(vague.missed_if_there, 0.9);
  EXPECT_GT(vague.missed_if_there, 0.1) << "it may still stand behind the board";
}

TEST(ObjectLooks, AVagueObjectIsNotGoneBecauseOneSeesPastIt) {
  View const view{.boards = {{kBoard}}};
  double const known = look(view, at(0.1, 1.5, 1e-4)).missed_if_there;
  double const vague = look(view, at(0.12, 1.53, 0.05)).missed_if_there;
  EXPECT_GE(known, vague);
  EXPECT_GT(vague, 10 * look({}, at(0.12, 1.53, 0.05)).missed_if_there);
}

// The same surface by the obvious way: a point faces the camera where its face does. Of a face that
// is seen at a grazing angle the rendering leaves points out: one hides the next.
TEST(ObjectLooks, FacingIsToldAsFacesTellIt) {
  for (double const turn_deg : {0.0, 20.0, 45.0, 70.0}) {
    PoseDistribution pose = at(0.1, 1.8, 0.0);
    pose.mean = Se3(rotation_of_rpy_deg({0, turn_deg, 0}), pose.mean.translation());
    int facing = 0;
    for (Eigen::Vector3f const& point : box().points_model) {
      Eigen::Vector3d const p = point.cast<double>();
      Eigen::Vector3d const from_camera = pose.mean * p;
      bool faces = false;
      for (int axis = 0; axis < 3; ++axis) {
        for (double const side : {-1.0, 1.0}) {
          double const face_m = axis == 2 ? (side > 0 ? 0.1 : 0.0) : side * 0.1;
          bool const on_it = std::abs(p[axis] - face_m) < box().spacing_m / 2;
          Eigen::Vector3d const normal =
              pose.mean.rotation() * (side * Eigen::Vector3d::Unit(axis));
          faces = faces || (on_it && normal.dot(from_camera) < 0);
        }
      }
      facing += faces ? 1 : 0;
    }
    int const rendered = total(look({}, pose).points);
    EXPECT_LT(rendered, 1.15 * facing) << turn_deg;
    EXPECT_GT(rendered, 0.5 * facing) << turn_deg;
  }
}

// 20 cm at 1.5 m are 20 pixels; blocks at the outline count whole.
TEST(ObjectLooks, PixelsAreThoseThatTheVisiblePartCovers) {
  double const whole = look({.boards = {{kBoard}}}, at(0.1, 1.5, 1e-4)).shown_px;
  EXPECT_GE(whole, 400.0);
  EXPECT_LT(whole, 600.0);
  Board const over_half{std::nullopt, -0.5, -0.5, 0.6, 1.0, 1.4};
  double const half = look({.boards = {{kBoard}, over_half}}, at(0.1, 1.5, 1e-4)).shown_px;
  EXPECT_NEAR(half / whole, 0.5, 0.1);
  double const farther = look({}, at(0.1, 2.5, 1e-4)).shown_px;
  EXPECT_NEAR(farther / whole, 0.36, 0.1);
}

TEST(ObjectLooks, WhatIsTooFarToBeFoundIsNotMissed) {
  ObjectLook const near = look({}, at(0.1, 1.5, 1e-4));
  ObjectLook const far = look({}, at(0.1, 2.8, 1e-4));
  EXPECT_EQ(far.visible_share, 1.0);
  EXPECT_GT(near.found_if_there, 0.2);
  EXPECT_EQ(far.found_if_there, 0.0);
}

TEST(FoundIfVisible, RisesWithTheVisibleShare) {
  ObjectFusionConfig config;
  config.never_found_share = 0.2;
  config.surely_found_share = 0.6;
  EXPECT_EQ(found_if_visible(0.0, 1e6, 0.9, config), 0.0);
  EXPECT_EQ(found_if_visible(0.2, 1e6, 0.9, config), 0.0);
  EXPECT_NEAR(found_if_visible(0.4, 1e6, 0.9, config), 0.45, 1e-12);
  EXPECT_NEAR(found_if_visible(0.6, 1e6, 0.9, config), 0.9, 1e-12);
  EXPECT_NEAR(found_if_visible(1.0, 1e6, 0.9, config), 0.9, 1e-12);
}

TEST(FoundIfVisible, RisesWithTheLogarithmOfPixels) {
  ObjectFusionConfig config;
  config.never_found_px = 100.0;
  config.surely_found_px = 10000.0;
  EXPECT_EQ(found_if_visible(1.0, 0.0, 0.9, config), 0.0);
  EXPECT_EQ(found_if_visible(1.0, 100.0, 0.9, config), 0.0);
  EXPECT_NEAR(found_if_visible(1.0, 1000.0, 0.9, config), 0.45, 1e-12);
  EXPECT_NEAR(found_if_visible(1.0, 10000.0, 0.9, config), 0.9, 1e-12);
  EXPECT_NEAR(found_if_visible(1.0, 1e6, 0.9, config), 0.9, 1e-12);
  config.never_found_share = 0.0;
  config.surely_found_share = 0.5;
  EXPECT_NEAR(found_if_visible(0.25, 1000.0, 0.9, config), 0.225, 1e-12) << "both";
}

// Limits that are one, or the wrong way round, are a step.
TEST(FoundIfVisible, MayBeAStep) {
  ObjectFusionConfig config;
  config.never_found_px = config.surely_found_px = 500.0;
  EXPECT_EQ(found_if_visible(1.0, 500.0, 0.9, config), 0.0);
  EXPECT_NEAR(found_if_visible(1.0, 501.0, 0.9, config), 0.9, 1e-12);
}

}  // namespace
}  // namespace credo
