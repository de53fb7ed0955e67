#include "detector/search/tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "detector/poses/pose_distance.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

PoseDistribution around(Se3 const& mean, double sigma_m, double sigma_rad) {
  PoseDistribution pose;
  pose.mean = mean;
  pose.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  return pose;
}

/// About the model's centre, so that a turn does not shift it.
Se3 strayed(SearchModel const& model, Se3 const& truth, double shift_m, double turn_rad,
            std::mt19937& random) {
  std::normal_distribution<float> number;
  auto const direction = [&] {
    return Eigen::Vector3f(number(random), number(random), number(random)).normalized();
  };
  return se3(perturbed(model, camera_pose(truth), static_cast<float>(shift_m) * direction(),
                       static_cast<float>(turn_rad) * direction()));
}

TEST(SearchNear, FindsWhatStrayedALittle) {
  std::mt19937 random(1);
  SearchModel const& model = prepared_bracket();
  for (double const yaw : {0.3, 2.2, 4.4}) {
    BracketView const view = bracket_on_desk(yaw, {SensorModel::kGaussian});
    for (int i = 0; i < 4; ++i) {
      Se3 const expected = strayed(model, view.T_camera_model, 0.015, 0.08, random);
      std::vector<PoseCandidate> const found =
          search_near(model, view.scene, around(expected, 0.01, 0.06), 1, 5);
      ASSERT_FALSE(found.empty());
      EXPECT_LT(mean_distance_m(model, found[0].pose, view.truth), 0.1 * model.diameter_m);
      EXPECT_GT(found[0].verification.log_odds, 0.0F);
    }
  }
}

TEST(SearchNear, FindsWhatStrayedFar) {
  std::mt19937 random(2);
  SearchModel const& model = prepared_bracket();
  BracketView const view = bracket_on_desk(1.1);
  int right = 0;
  for (int i = 0; i < 8; ++i) {
    Se3 const expected = strayed(model, view.T_camera_model, 0.035, 0.25, random);
    std::vector<PoseCandidate> const found =
        search_near(model, view.scene, around(expected, 0.025, 0.15), 1, 5);
    right +=
        !found.empty() && mean_distance_m(model, found[0].pose, view.truth) < 0.1 * model.diameter_m
            ? 1
            : 0;
  }
  EXPECT_GE(right, 6);
}

TEST(SearchNear, TheLikeliestComesFirstAndNoneIsTwice) {
  SearchModel const& model = prepared_bracket();
  BracketView const view = bracket_on_desk(0.3);
  PoseDistance const distance(model);
  for (std::size_t const most : {std::size_t{1}, std::size_t{3}, std::size_t{8}}) {
    std::vector<PoseCandidate> const found =
        search_near(model, view.scene, around(view.T_camera_model, 0.03, 0.2), 1, most);
    EXPECT_LE(found.size(), most);
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE(found[j].verification.log_odds, found[i].verification.log_odds);
        EXPECT_GT(distance(found[i].pose, found[j].pose), 0.02F * model.diameter_m);
      }
    }
  }
}

TEST(SearchNear, TheSameSeedGivesTheSame) {
  BracketView const view = bracket_on_desk(0.3, {SensorModel::kGaussian});
  auto const found = [&](std::uint64_t seed) {
    return search_near(prepared_bracket(), view.scene, around(view.T_camera_model, 0.02, 0.1), seed,
                       5);
  };
  std::vector<PoseCandidate> const one = found(7);
  std::vector<PoseCandidate> const again = found(7);
  ASSERT_EQ(one.size(), again.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].pose.rotation, again[i].pose.rotation);
    EXPECT_EQ(one[i].pose.translation_m, again[i].pose.translation_m);
    EXPECT_EQ(one[i].verification.log_odds, again[i].verification.log_odds);
  }
  std::vector<PoseCandidate> const other = found(8);
  ASSERT_FALSE(one.empty());
  ASSERT_FALSE(other.empty());
  EXPECT_NE(one[0].pose.translation_m, other[0].pose.translation_m);
}

TEST(SearchNear, WhatIsSureIsNotDrawnAround) {
  BracketView const view = bracket_on_desk(0.3);
  std::vector<PoseCandidate> const found =
      search_near(prepared_bracket(), view.scene, {view.T_camera_model, Matrix6d::Zero()}, 1, 5);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(mean_distance_m(prepared_bracket(), found[0].pose, view.truth), 0.005);
}

TEST(SearchNear, WhereNothingIsSeenNothingIsLikely) {
  Frame frame;
  frame.cloud_camera = cloud_from_depth(Grid<float>(640, 480, 0.0F), frame.intrinsics);
  BracketView const view = bracket_on_desk(0.3);
  for (PoseCandidate const& candidate : search_near(prepared_bracket(), scene_of(frame),
                                                    around(view.T_camera_model, 0.01, 0.1), 1, 5)) {
    EXPECT_LT(candidate.verification.log_odds, -5.0F);
  }
}

/// A can on the desk whose turn nobody knows.
TEST(SearchNear, FindsACanHoweverItIsTurned) {
  SearchModel const model = prepare_model(can(0.04, 0.12));
  std::vector<Placed> things = desk_and_floor();
  Se3 const T_world_can = placed_at({0.05, 0.0, 0.0});
  things.push_back({can(0.04, 0.12), T_world_can});
  SearchScene const scene = scene_of(*frame_of(things, before_desk()));
  Se3 const truth = before_desk().inverse() * T_world_can;
  // A metre of turn about its axis, in the world; little else.
  PoseDistribution in_world = around(T_world_can, 0.008, 0.03);
  in_world.covariance(5, 5) = 4.0;
  PoseDistribution const expected = transformed(before_desk().inverse(), in_world);
  EXPECT_TRUE(can_track(model, expected));
  std::vector<PoseCandidate> const found = search_near(model, scene, expected, 1, 5);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(PoseDistance(model)(found[0].pose, camera_pose(truth)), 0.01F);
  EXPECT_GT(found[0].verification.log_odds, 0.0F);
}

TEST(CanTrack, WhatIsKnownWell) {
  SearchModel const& model = prepared_bracket();
  Se3 const mean = bracket_on_desk(0.3).T_camera_model;
  EXPECT_TRUE(can_track(model, around(mean, 0.0, 0.0)));
  EXPECT_TRUE(can_track(model, around(mean, 0.01, 0.08)));
  EXPECT_TRUE(can_track(model, around(mean, 0.02, 0.15)));
  EXPECT_FALSE(can_track(model, around(mean, 0.3, 0.08)));
  EXPECT_FALSE(can_track(model, around(mean, 0.01, 2.0)));
  EXPECT_FALSE(can_track(model, around(mean, 10.0, 10.0)));
}

TEST(CanTrack, TheMoreTheWiderNever) {
  SearchModel const& model = prepared_bracket();
  Se3 const mean = bracket_on_desk(0.3).T_camera_model;
  for (bool const turns : {false, true}) {
    bool before = true;
    for (double sigma = 0.001; sigma < 3.0; sigma *= 1.3) {
      bool const now =
          can_track(model, turns ? around(mean, 0.0, sigma) : around(mean, sigma, 0.0));
      EXPECT_TRUE(before || !now) << sigma;
      before = now;
    }
    EXPECT_FALSE(before);
  }
}

TEST(CanTrack, OnlyTurnsAboutTheAxisAreFree) {
  SearchModel const model = prepare_model(can(0.04, 0.12));
  Se3 const mean(Eigen::Quaterniond(Eigen::AngleAxisd(0.9, Eigen::Vector3d::UnitX())), {0, 0, 1});
  Eigen::Vector3d const axis = mean.rotation() * Eigen::Vector3d::UnitZ();
  PoseDistribution about = around(mean, 0.005, 0.02);
  about.covariance.bottomRightCorner<3, 3>() += 9.0 * axis * axis.transpose();
  EXPECT_TRUE(can_track(model, about));
  SearchModel without = model;
  without.symmetry = {};
  EXPECT_FALSE(can_track(without, about));
  PoseDistribution across = around(mean, 0.005, 0.02);
  Eigen::Vector3d const side = axis.unitOrthogonal();
  across.covariance.bottomRightCorner<3, 3>() += 9.0 * side * side.transpose();
  EXPECT_FALSE(can_track(model, across));
}

}  // namespace
}  // namespace credo::test
