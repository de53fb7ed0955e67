#include "tools/history_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "history/history.hpp"
#include "history/runs.hpp"

namespace credo::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

ThingHistory of_ten() {
  return histories_of(run_of_ten())[0];
}

TEST(HistoryText, TellsWhatHappenedWhen) {
  EXPECT_EQ(
      history_text(of_ten(), false),
      "stuff:7: a thing that nobody told of\n"
      "  first in frame 2, at 0.20 s, with probability 0.731\n"
      "  last in frame 8, with 0.269; forgotten in frame 9\n"
      "\n"
      "                  time [s]                              of its points [%]               "
      "news\n"
      "  frames          from       to  evidence      agree  hidden  through   blind    out "
      "[looks]      log-odds         probability\n"
      "  2-3             0.20     0.30  seen             75      25        0       0      0    0.50"
      "    1.00 to  3.00*   0.731 to 0.953\n"
      "  4-6             0.40     0.60  occluded          -       -        -       -      -    0.00"
      "    3.00 to  3.00    0.953 to 0.953\n"
      "  7-8             0.70     0.80  seen through      -       -        -       -      -    1.50"
      "    3.00 to -1.00    0.953 to 0.269\n"
      "  * at the bound of log-odds: more of the same adds nothing\n"
      "\n"
      "  probability over frames\n"
      "   1.0 | ▅▅▅  \n"
      "       | ███  \n"
      "       |▇███▇ \n"
      "       |█████ \n"
      "   0.5 |█████ \n"
      "       |█████▁\n"
      "       |██████\n"
      "       |██████\n"
      "   0.0 +ssooTT\n"
      "        2         8\n"
      "        s seen   T seen through   o occluded   . out of view   - not seen\n");
}

TEST(HistoryText, HasColourWhereItIsWanted) {
  EXPECT_THAT(history_text(of_ten(), false), Not(HasSubstr("\033")));
  std::string const colored = history_text(of_ten(), true);
  EXPECT_THAT(colored, HasSubstr("\033[31mseen through \033[0m"));
  EXPECT_THAT(colored, HasSubstr("\033[32m█\033[0m"));
}

std::string ending(double last_log_odds, bool to_the_end) {
  std::vector<BeliefSummary> run = run_of_ten();
  run[7].stuff[0].log_odds = last_log_odds;
  if (to_the_end) {
    run.pop_back();
  }
  return history_text(histories_of(run)[0], false);
}

TEST(HistoryText, TellsHowItEnds) {
  EXPECT_THAT(ending(-1.0, false), HasSubstr("; forgotten in frame 9\n"));
  EXPECT_THAT(ending(3.0, false),
              HasSubstr("; gone from frame 9 on: seen through, or one with something else\n"));
  EXPECT_THAT(ending(-1.0, true), HasSubstr("  in the run's last frame, 8, with 0.269\n"));
}

TEST(HistoryText, TellsWithWhatItBecameOne) {
  ThingHistory history = of_ten();
  EXPECT_EQ(json::parse(history_json(history))["joined"], nullptr);
  history.joined = "stuff:12";
  EXPECT_THAT(history_text(history, false), HasSubstr("; one with stuff:12 from frame 9 on\n"));
  EXPECT_EQ(json::parse(history_json(history))["joined"], "stuff:12");
}

TEST(HistoryText, TellsWhatAccountsDoNotExplain) {
  EXPECT_THAT(history_text(of_ten(), false), Not(HasSubstr("`moved`")));
  EXPECT_THAT(ending(3.0, false), HasSubstr("From frame 8 on its log-odds are not what"));
}

TEST(HistoryText, HasNoFootnoteWithoutABound) {
  std::vector<BeliefSummary> run = run_of_ten();
  run[3].stuff[0].why->bounded = false;
  EXPECT_THAT(history_text(histories_of(run)[0], false), Not(HasSubstr("*")));
}

TEST(HistoriesTable, HasARowForEachThing) {
  EXPECT_EQ(histories_table({of_ten()}),
            "  id                    first   last       p  moved by  what happened last\n"
            "  stuff:7                   2      8   0.269      6.00  seen through since frame 7, "
            "forgotten in frame 9\n");
}

TEST(HistoryJson, HasAllThatTheTextHas) {
  json const thing = json::parse(history_json(of_ten()));
  EXPECT_EQ(thing["id"], "stuff:7");
  EXPECT_EQ(thing["kind"], "stuff");
  EXPECT_EQ(thing["type"], nullptr);
  EXPECT_EQ(thing["first_frame"], 2);
  EXPECT_EQ(thing["last_frame"], 8);
  EXPECT_EQ(thing["gone_frame"], 9);
  EXPECT_EQ(thing["log_odds"], -1.0);
  EXPECT_EQ(thing["travelled"], 6.0);
  ASSERT_EQ(thing["spans"].size(), 3U);
  json const& seen = thing["spans"][0];
  EXPECT_EQ(seen["frames"], json({2, 3}));
  EXPECT_EQ(seen["evidence"], "seen");
  EXPECT_EQ(seen["points"]["agrees"], 0.75);
  EXPECT_EQ(seen["points"]["occluded"], 0.25);
  EXPECT_EQ(seen["news"], 0.5);
  EXPECT_EQ(seen["moved"], 2.0);
  EXPECT_EQ(seen["log_odds"], json({1.0, 3.0}));
  EXPECT_EQ(seen["probability"], json({probability_of(1.0), probability_of(3.0)}));
  EXPECT_EQ(seen["bounded_frames"], 1);
  EXPECT_EQ(thing["spans"][1]["points"], nullptr);
}

TEST(HistoryJson, OfAllHasNoSpans) {
  std::vector<BeliefSummary> run = run_of_ten();
  run.pop_back();
  json const things = json::parse(histories_json(histories_of(run)));
  ASSERT_EQ(things.size(), 1U);
  EXPECT_EQ(things[0]["id"], "stuff:7");
  EXPECT_EQ(things[0]["gone_frame"], nullptr);
  EXPECT_FALSE(things[0].contains("spans"));
  EXPECT_EQ(histories_json({}), "[]\n");
}

}  // namespace
}  // namespace credo::test
