// Things that appear before a sensor that stands still, and one that is pushed.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "end_to_end/recording_views.hpp"
#include "io/dataset.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

std::vector<BeliefPtr> beliefs_of(std::string const& recording) {
  std::vector<BeliefPtr> beliefs;
  for_each_result(open_dataset(recordings() / recording, {}, {}).source, {},
                  [&](FrameResult const& result) { beliefs.push_back(result.belief); });
  return beliefs;
}

StuffBelief const* find(BeliefState const& belief, std::uint32_t id) {
  auto const found = std::ranges::find(belief.stuff, id, &StuffBelief::id);
  return found == belief.stuff.end() ? nullptr : &*found;
}

/// What a belief has that the one before had not, of so many pixels and more.
std::vector<StuffBelief> new_things(BeliefState const& before, BeliefState const& now,
                                    std::size_t least_pixels) {
  std::vector<StuffBelief> things;
  for (StuffBelief const& item : now.stuff) {
    if (find(before, item.id) == nullptr && item.latest().pixel_count >= least_pixels) {
      things.push_back(item);
    }
  }
  return things;
}

/// How many things are believed to be in the middle of that place, give or take 4 cm.
std::ptrdiff_t things_at(BeliefState const& belief, Eigen::Vector3f const& place_world) {
  return std::ranges::count_if(belief.stuff, [&](StuffBelief const& item) {
    return (item.latest().centroid_world - place_world).norm() < 0.04F &&
           probability_of(item.log_odds) >= 0.5;
  });
}

class AppearingBoxes : public testing::TestWithParam<char const*> {};

TEST_P(AppearingBoxes, AreBelievedAtOnceAndFollowedWherePushed) {
  std::string const recording = std::string("appearing-boxes/") + GetParam();
  CREDO_REQUIRE_RECORDING(recording);
  std::vector<BeliefPtr> const beliefs = beliefs_of(recording);
  ASSERT_EQ(beliefs.size(), 11U);
  for (std::size_t frame = 1; frame < 8; ++frame) {
    EXPECT_TRUE(new_things(*beliefs[frame - 1], *beliefs[frame], 2500).empty()) << frame;
  }
  std::vector<StuffBelief> const boxes = new_things(*beliefs[7], *beliefs[8], 2500);
  ASSERT_EQ(boxes.size(), 2U);
  int pushed = 0;
  for (StuffBelief const& box : boxes) {
    EXPECT_GE(probability_of(box.log_odds), 0.5);
    Eigen::Vector3f const from = box.latest().centroid_world;
    StuffBelief const* const then = find(*beliefs[9], box.id);
    StuffBelief const* const last = find(*beliefs[10], box.id);
    ASSERT_TRUE(then != nullptr && last != nullptr);
    EXPECT_GE(probability_of(last->log_odds), 0.5);
    if ((last->latest().centroid_world - from).norm() > 0.08F) {
      ++pushed;
      // No ghost of it, neither where it stood first nor where it stood then.
      EXPECT_EQ(things_at(*beliefs[9], from), 0);
      EXPECT_EQ(things_at(*beliefs[10], from), 0);
      EXPECT_EQ(things_at(*beliefs[10], then->latest().centroid_world), 0);
    }
  }
  EXPECT_EQ(pushed, 1);
  EXPECT_TRUE(new_things(*beliefs[8], *beliefs[10], 2500).empty());
}

INSTANTIATE_TEST_SUITE_P(Cameras, AppearingBoxes, testing::Values("cam1", "cam2"),
                         [](auto const& instance) { return std::string(instance.param); });

TEST(Thermos, IsBelievedAtOnce) {
  CREDO_REQUIRE_RECORDING("thermos");
  std::vector<BeliefPtr> const beliefs = beliefs_of("thermos");
  ASSERT_EQ(beliefs.size(), 15U);
  std::vector<StuffBelief> const found = new_things(*beliefs[11], *beliefs[12], 1000);
  ASSERT_EQ(found.size(), 1U);
  Eigen::Vector3f const size_m = found[0].latest().bounds_world.sizes();
  EXPECT_NEAR(size_m.z(), 0.2F, 0.04F);
  EXPECT_LT(size_m.head<2>().maxCoeff(), 0.12F);
  EXPECT_GE(probability_of(found[0].log_odds), 0.5);
  for (std::size_t frame = 0; frame < 12; ++frame) {
    EXPECT_EQ(things_at(*beliefs[frame], found[0].latest().centroid_world), 0) << frame;
  }
  StuffBelief const* const last = find(*beliefs[14], found[0].id);
  ASSERT_NE(last, nullptr);
  EXPECT_GT(last->log_odds, found[0].log_odds);
}

}  // namespace
}  // namespace credo::test
