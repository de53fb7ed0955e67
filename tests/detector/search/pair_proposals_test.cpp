#include "detector/search/pair_proposals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

PairTable const& bracket_pairs() {
  static PairTable const pairs(prepared_bracket());
  return pairs;
}

bool near(SearchModel const& model, CameraPose const& pose, CameraPose const& truth) {
  float const shift_m = (pose * model.centre_model - truth * model.centre_model).norm();
  return shift_m < 0.1F * model.diameter_m &&
         angle_between(pose, truth) < 15.0 * std::numbers::pi / 180.0;
}

class TurnedBracket : public ::testing::TestWithParam<double> {};

TEST_P(TurnedBracket, ItsPoseIsProposed) {
  BracketView const view = bracket_on_desk(GetParam());
  std::vector<Proposal> const proposals =
      propose_by_pairs(prepared_bracket(), bracket_pairs(), view.scene, {});
  EXPECT_TRUE(std::ranges::any_of(proposals, [&](Proposal const& proposal) {
    return near(prepared_bracket(), proposal.pose, view.truth);
  })) << proposals.size();
}

INSTANTIATE_TEST_SUITE_P(Yaws, TurnedBracket, ::testing::Values(0.3, 1.9, 3.5, 5.1));

TEST(PairProposals, AreMotions) {
  BracketView const view = bracket_on_desk(0.3);
  for (Proposal const& proposal :
       propose_by_pairs(prepared_bracket(), bracket_pairs(), view.scene, {})) {
    Eigen::Matrix3f const& R = proposal.pose.rotation;
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3f::Identity()).cwiseAbs().maxCoeff(), 1e-4F);
    EXPECT_NEAR(R.determinant(), 1.0F, 1e-4F);
  }
}

TEST(PairProposals, ComeInTheOrderOfTheSegmentsAndOfNoneThatIsTooLarge) {
  BracketView const view = bracket_on_desk(0.3);
  SearchModel const& model = prepared_bracket();
  std::vector<Proposal> const proposals = propose_by_pairs(model, bracket_pairs(), view.scene, {});
  EXPECT_TRUE(std::ranges::is_sorted(proposals, {}, &Proposal::segment));
  for (Proposal const& proposal : proposals) {
    ASSERT_GE(proposal.segment, 1);
    SceneSegment const& segment = view.scene.segments.at(proposal.segment - 1U);
    EXPECT_LT(segment.extent_m, 0.5F) << "the desk is no bracket";
    Eigen::Vector3f const centre = proposal.pose * model.centre_model;
    EXPECT_LT((centre - segment.centre_m).norm(), segment.extent_m + 1.5F * model.diameter_m);
  }
}

TEST(PairProposals, AreTheSameEachTime) {
  BracketView const view = bracket_on_desk(1.9);
  auto const one = propose_by_pairs(prepared_bracket(), bracket_pairs(), view.scene, {});
  auto const again = propose_by_pairs(prepared_bracket(), bracket_pairs(), view.scene, {});
  ASSERT_EQ(one.size(), again.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].pose.rotation, again[i].pose.rotation);
    EXPECT_EQ(one[i].pose.translation_m, again[i].pose.translation_m);
  }
}

TEST(PairProposals, WhereNothingIsSeenThereAreNone) {
  Frame frame;
  frame.cloud_camera = cloud_from_depth(Grid<float>(640, 480, 0.0F), frame.intrinsics);
  EXPECT_TRUE(propose_by_pairs(prepared_bracket(), bracket_pairs(), scene_of(frame), {}).empty());
  FramePtr const bare = frame_of(desk_and_floor(), before_desk());
  EXPECT_TRUE(propose_by_pairs(prepared_bracket(), bracket_pairs(), scene_of(*bare), {}).empty())
      << "planes larger than the model";
}

TEST(PairProposals, PointsOnALargePlaneSpeakForNothing) {
  SearchScene scene = bracket_on_desk(0.3).scene;
  ASSERT_FALSE(scene.planes.empty());
  for (ScenePixel& pixel : scene.pixels) {
    pixel.plane = 0;
  }
  EXPECT_TRUE(propose_by_pairs(prepared_bracket(), bracket_pairs(), scene, {}).empty());
}

TEST(PairProposals, WhatIsExplainedProposesNothing) {
  SearchScene const scene = bracket_on_desk(0.3).scene;
  std::vector<Proposal> const all =
      propose_by_pairs(prepared_bracket(), bracket_pairs(), scene, {});
  ASSERT_FALSE(all.empty());
  std::uint16_t const segment = all.front().segment;
  ClaimedPixels explained(scene.pixels.width(), scene.pixels.height(), 0);
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    explained[i] = scene.pixels[i].segment == segment ? 1 : 0;
  }
  auto const rest = propose_by_pairs(prepared_bracket(), bracket_pairs(), scene, explained);
  EXPECT_TRUE(std::ranges::none_of(rest, [&](Proposal const& p) { return p.segment == segment; }));
  auto const of_others =
      std::ranges::count_if(all, [&](Proposal const& p) { return p.segment != segment; });
  EXPECT_GT(static_cast<std::ptrdiff_t>(rest.size()), of_others) << "the others propose more";
  explained = ClaimedPixels(scene.pixels.width(), scene.pixels.height(), 0);
  EXPECT_EQ(propose_by_pairs(prepared_bracket(), bracket_pairs(), scene, explained).size(),
            all.size());
}

}  // namespace
}  // namespace credo::test
