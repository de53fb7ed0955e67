#include "detector/search/joint_detection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

constexpr float kLeast = 0.3F;

PoseCandidate candidate_at(SearchScene const& scene, CameraPose const& pose) {
  return {pose, verified(prepared_bracket(), scene, pose, {})};
}

class TwoBrackets : public ::testing::Test {
protected:
  TwoBrackets() {
    std::vector<Placed> things = desk_and_floor();
    for (double const x : {-0.15, 0.15}) {
      Se3 const T_world_model = placed_at({x, 0, 0}, 0.3);
      things.push_back({bracket(), T_world_model});
      truths_.push_back(camera_pose(before_desk().inverse() * T_world_model));
    }
    scene_ = scene_of(*frame_of(things, before_desk()));
  }
  [[nodiscard]] std::vector<std::optional<PoseCandidate>> chosen(
      std::vector<std::vector<CameraPose>> const& poses, float least = kLeast) const {
    std::vector<ObjectCandidates> objects;
    for (std::vector<CameraPose> const& of_object : poses) {
      objects.push_back({&prepared_bracket(), {}});
      for (CameraPose const& pose : of_object) {
        objects.back().candidates.push_back(candidate_at(scene_, pose));
      }
    }
    return choose_jointly(objects, scene_, least);
  }
  [[nodiscard]] double error_m(std::optional<PoseCandidate> const& found, std::size_t truth) const {
    return mean_distance_m(prepared_bracket(), found.value().pose, truths_[truth]);
  }

  SearchScene scene_;
  std::vector<CameraPose> truths_;
};

TEST_F(TwoBrackets, TwoObjectsShareTwoPlaces) {
  // Both would be at the first place, one of them might be at the second.
  CameraPose const beside = perturbed(prepared_bracket(), truths_[1], {0.003F, 0, 0}, {0, 0, 0});
  auto const found = chosen({{truths_[0]}, {truths_[0], beside}});
  ASSERT_EQ(found.size(), 2U);
  ASSERT_TRUE(found[0] && found[1]);
  EXPECT_LT(error_m(found[0], 0), 1e-6);
  EXPECT_LT(error_m(found[1], 1), 0.005);
}

TEST_F(TwoBrackets, TwoPosesInOnePlaceAreOne) {
  auto const found = chosen({{truths_[0]}, {truths_[0]}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NE(found[0].has_value(), found[1].has_value());
}

TEST_F(TwoBrackets, OneObjectIsFoundOnce) {
  auto const found = chosen({{truths_[1], truths_[0]}});
  ASSERT_EQ(found.size(), 1U);
  ASSERT_TRUE(found[0].has_value());
}

TEST_F(TwoBrackets, NoProbabilityRisesAndNoPixelIsExplainedTwice) {
  std::vector<CameraPose> poses;
  for (float const off_m : {-0.02F, -0.01F, 0.0F, 0.01F}) {
    for (CameraPose const& truth : truths_) {
      poses.push_back(perturbed(prepared_bracket(), truth, {off_m, 0, 0}, {0, 0, 0}));
    }
  }
  std::vector<std::vector<CameraPose>> objects;
  for (CameraPose const& pose : poses) {
    objects.push_back({pose});
  }
  auto const found = chosen(objects, 0.05F);
  ASSERT_EQ(found.size(), poses.size());
  std::vector<int> explained(scene_.pixels.size(), 0);
  int count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) {
      continue;
    }
    ++count;
    EXPECT_LE(found[i]->verification.log_odds,
              candidate_at(scene_, poses[i]).verification.log_odds);
    EXPECT_GE(found[i]->probability, 0.05F);
    for (std::uint32_t const pixel : found[i]->verification.explained_px) {
      EXPECT_EQ(++explained[pixel], 1);
    }
  }
  EXPECT_GE(count, 2);
}

TEST_F(TwoBrackets, WhatIsUnlikelyIsNotFound) {
  CameraPose const nowhere =
      perturbed(prepared_bracket(), truths_[0], {0, -0.15F, -0.05F}, {0, 0, 0});
  auto const found = chosen({{nowhere}, {truths_[1]}});
  EXPECT_FALSE(found[0].has_value());
  EXPECT_TRUE(found[1].has_value());
  EXPECT_FALSE(chosen({{truths_[0]}}, 0.9999F)[0].has_value());
}

// Two that the choice takes for apart: what the better one explains is hidden from the other.
TEST_F(TwoBrackets, WhatOneExplainsHidesTheNext) {
  PoseCandidate const better = candidate_at(scene_, truths_[0]);
  PoseCandidate worse = better;
  worse.verification.explained_px = {0};
  worse.verification.log_odds = better.verification.log_odds - 0.01F;
  auto const found = choose_jointly(
      {{&prepared_bracket(), {worse}}, {&prepared_bracket(), {better}}}, scene_, kLeast);
  EXPECT_FALSE(found[0].has_value());
  EXPECT_TRUE(found[1].has_value());
}

TEST_F(TwoBrackets, AProbabilityStaysAsLowAsItWasAlone) {
  PoseCandidate unlikely = candidate_at(scene_, truths_[0]);
  unlikely.verification.log_odds = -0.5F;
  auto const found = choose_jointly({{&prepared_bracket(), {unlikely}}}, scene_, kLeast);
  ASSERT_TRUE(found[0].has_value());
  EXPECT_EQ(found[0]->verification.log_odds, -0.5F);
  EXPECT_LT(found[0]->probability, 0.9F);
}

TEST_F(TwoBrackets, WhatTheLikelyOnesExplainIsKnown) {
  auto found = chosen({{truths_[0]}, {truths_[1]}});
  ASSERT_TRUE(found[0] && found[1]);
  found[1]->probability = 0.4F;
  found.emplace_back(std::nullopt);
  ClaimedPixels const explained = explained_by(found, scene_, 0.5F);
  ASSERT_EQ(explained.size(), scene_.pixels.size());
  auto const& of_first = found[0]->verification.explained_px;
  EXPECT_EQ(std::ranges::count(explained, 1), static_cast<std::ptrdiff_t>(of_first.size()));
  EXPECT_TRUE(
      std::ranges::all_of(of_first, [&](std::uint32_t pixel) { return explained[pixel] == 1; }));
}

TEST_F(TwoBrackets, WithoutCandidatesNothingIsFound) {
  EXPECT_TRUE(chosen({}).empty());
  auto const found = choose_jointly({{nullptr, {}}, {&prepared_bracket(), {}}}, scene_, kLeast);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0] || found[1]);
}

}  // namespace
}  // namespace credo::test
