#include "history/history_columns.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "history/history.hpp"
#include "history/runs.hpp"

namespace credo::test {
namespace {

TEST(Columns, AreAFrameEachWhereThereIsRoom) {
  ThingHistory const history = histories_of(run_of_ten())[0];
  auto const columns = columns_of(history, 72);
  ASSERT_EQ(columns.size(), 6U);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    ASSERT_TRUE(columns[i]);
    EXPECT_EQ(columns[i]->probability, history.moments[i].probability);
    EXPECT_EQ(columns[i]->evidence, history.moments[i].evidence);
  }
}

// Of frames with the evidence s s o | o t t: the most, after the last.
TEST(Columns, OfManyFramesHaveWhatMostOfThemHad) {
  ThingHistory const history = histories_of(run_of_ten())[0];
  auto const two = columns_of(history, 2);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0]->evidence, Evidence::kSeen);
  EXPECT_EQ(two[0]->probability, probability_of(3.0));
  EXPECT_EQ(two[1]->evidence, Evidence::kSeenThrough);
  EXPECT_EQ(two[1]->probability, probability_of(-1.0));
  auto const one = columns_of(history, 0);
  ASSERT_EQ(one.size(), 1U) << "at least one";
  EXPECT_EQ(one[0]->evidence, Evidence::kSeenThrough) << "of as many, the last";
}

TEST(Columns, AreEmptyWhereTheThingWasNotBelieved) {
  std::vector<BeliefSummary> run;
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    run.push_back(empty_belief(frame));
  }
  run[0].stuff = run[2].stuff = {stuff_at(1, 2.0, Evidence::kSeen, 0.0)};
  auto const columns = columns_of(histories_of(run)[0], 72);
  ASSERT_EQ(columns.size(), 3U);
  EXPECT_TRUE(columns[0] && !columns[1] && columns[2]);
}

}  // namespace
}  // namespace credo::test
