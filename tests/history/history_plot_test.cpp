#include "history/history_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "history/history.hpp"
#include "history/runs.hpp"

namespace credo::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(std::string const& text, std::string const& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++found;
  }
  return found;
}

// The axes go from 60 to 620 px, 0.2 s to 0.9 s: 80 px a frame.
TEST(HistoryPlot, HasABandForEachSpan) {
  std::string const svg = history_plot(histories_of(run_of_ten())[0], {4.6, 0.15});
  EXPECT_THAT(svg, HasSubstr(R"(<rect x="60" y="30" width="160" height="120" fill="#009e73")"))
      << "seen from 0.2 s until it is hidden";
  EXPECT_THAT(svg, HasSubstr(R"(<rect x="220" y="30" width="240" height="120" fill="#e6ac00")"))
      << "hidden from 0.4 s until it is seen through, a lost frame between";
  EXPECT_THAT(svg, HasSubstr(R"(<rect x="460" y="30" width="160" height="120" fill="#d55e00")"))
      << "seen through from 0.7 s until it is forgotten";
  EXPECT_EQ(count(svg, "height=\"120\" fill="), 6U) << "behind probability and log-odds";
}

TEST(HistoryPlot, DrawsProbabilityAndLogOddsToScale) {
  std::string const svg = history_plot(histories_of(run_of_ten())[0], {4.6, 0.15});
  // 1 - 0.731 of 120 px below 30 px; log-odds 1 of -5 to 5 over 120 px from 200 px.
  EXPECT_THAT(svg, HasSubstr("<polyline points=\"60,62.2"));
  EXPECT_THAT(svg, HasSubstr("<polyline points=\"60,248 140,224 220,224 380,224 460,248 540,272"));
  EXPECT_THAT(svg, HasSubstr("time [s]"));
  EXPECT_THAT(svg, HasSubstr(">frame<"));
  EXPECT_EQ(count(svg, ">bound<"), 2U);
  EXPECT_EQ(count(svg, ">forgotten below<"), 1U);
  EXPECT_THAT(svg, HasSubstr("stuff:7: probability that it is there"));
}

TEST(HistoryPlot, LeavesOutBoundsThatAreNotKnown) {
  std::string const svg = history_plot(histories_of(run_of_ten())[0], {});
  EXPECT_THAT(svg, Not(HasSubstr(">bound<")));
  EXPECT_THAT(svg, Not(HasSubstr(">forgotten below<")));
}

// Of frame 3's points half agree and half are hidden.
TEST(HistoryPlot, StacksThePoints) {
  std::string const svg = history_plot(histories_of(run_of_ten())[0], {});
  EXPECT_THAT(svg, HasSubstr("points of its surface"));
  // From 370 to 490 px; a third of the way up to the right: 100, 50, then nothing is told.
  EXPECT_THAT(svg, HasSubstr("<polyline points=\"60,490 140,490 220,490 380,490 460,490 540,490 "
                             "540,490 460,490 380,490 220,490 140,430 60,370\""));
}

TEST(HistoryPlot, OfASingleFrameOfARun) {
  std::vector<BeliefSummary> run = {empty_belief(0)};
  run[0].stuff = {stuff_at(1, 2.0, Evidence::kSeen, 0.0)};
  std::string const svg = history_plot(histories_of(run)[0], {});
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_EQ(count(svg, "</svg>"), 1U);
}

TEST(HistoryPlot, HoldsWhateverNamesAndLogOddsThereAre) {
  std::vector<BeliefSummary> run = {empty_belief(0), empty_belief(1)};
  for (BeliefSummary& belief : run) {
    ObjectSummary& object = belief.objects.emplace_back();
    object.id = "<a & b>\x1b";
    object.log_odds = std::numeric_limits<double>::infinity();
    object.probability = 1.0;
  }
  std::string const svg = history_plot(histories_of(run)[0], {});
  EXPECT_THAT(svg, HasSubstr("&lt;a &amp; b&gt; :"));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(svg, Not(HasSubstr("\x1b")));
  EXPECT_THAT(svg, Not(HasSubstr(">forgotten below<")));
}

}  // namespace
}  // namespace credo::test
