#include "eval/plots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/perfect_run.hpp"

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

TEST(Plots, ADotForEachBinThatHasClaims) {
  ExistenceScorer scorer;
  scorer.add(0.05, false);
  scorer.add(0.95, true);
  scorer.add(0.95, false);
  std::string const svg = reliability_plot(*scorer.scores());
  EXPECT_EQ(count(svg, "<circle"), 2U);
  // The axes go from 60 to 420 px, upwards from 390 to 30: half of those at 0.95 were there.
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"402\" cy=\"210\""));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"78\" cy=\"390\""));
}

TEST(Plots, AStripForEachScoreThatThereIs) {
  std::string const all = frames_plot(evaluated(perfect_run(3)).trace());
  EXPECT_THAT(all, HasSubstr("tilt of the floor"));
  EXPECT_THAT(all, HasSubstr("box_1"));
  EXPECT_THAT(all, HasSubstr("bottle_1"));
  std::vector<RunFrame> run = perfect_run(3);
  for (RunFrame& frame : run) {
    frame.belief.floor.reset();
    frame.belief.objects[0].id = "<box>";
  }
  std::string const some = frames_plot(evaluated(run).trace());
  EXPECT_THAT(some, Not(HasSubstr("tilt of the floor")));
  EXPECT_THAT(some, HasSubstr("&lt;box&gt;"));
  EXPECT_THAT(some, Not(HasSubstr("<box>")));
}

TEST(Plots, FramesThatWereLostLeaveAGap) {
  std::vector<FrameScores> trace(3);
  for (std::size_t i = 0; i < 3; ++i) {
    trace[i].weighted_overlap = 1.0;
  }
  trace[1].frame = FrameIndex{1};
  trace[2].frame = FrameIndex{3};
  EXPECT_EQ(count(frames_plot(trace), "stroke=\"#1f77b4\""), 1U) << "from frame 0 to 1 only";
}

}  // namespace
}  // namespace credo::test
