// What runs and simulations write is read back to the same bytes; what is not such a file is told
// by its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/belief_json.hpp"
#include "io/beliefs.hpp"
#include "io/truth_json.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

std::string replaced(std::string text, std::string const& what, std::string const& by) {
  std::size_t const at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what << " in " << text;
  return text.replace(at, what.size(), by);
}

class Readers : public ::testing::Test {
protected:
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "file.jsonl"; }
  /// What reading these lines throws, after the path.
  template <typename Read>
  std::string error_of(std::string const& text, Read const& read) {
    write_text(path(), text);
    try {
      read(path());
    } catch (InputError const& error) {
      std::string const message = error.what();
      EXPECT_EQ(message.rfind(path().string() + ":", 0), 0U) << message;
      return message.substr(path().string().size() + 1);
    }
    return "no error";
  }

  TempFolder folder_;
};

std::string belief_line() {
  BeliefState belief = belief_of_a_kitchen();
  belief.floor->height_m = 1.0 / 3.0;
  return belief_json(summary_of(belief));
}

FrameTruth kitchen_truth() {
  FrameTruth truth;
  truth.frame = FrameIndex{3};
  truth.stamp_ns = 1'700'000'000'123'456'789;
  // Not turned: the way through a matrix rounds the last bits.
  truth.T_world_camera = Se3(Eigen::Quaterniond::Identity(), {0.1, 0.2, 1.0 / 3.0});
  truth.floor = TrueFloor{};
  TrueWall wall;
  wall.id = "north";
  wall.segment_end_m = {3, 0.1};
  wall.visible_fraction = 0.25;
  truth.walls = {wall};
  truth.objects = {{"box", "green-box", Se3(Eigen::Quaterniond(0.6, 0, 0, 0.8), {1, 2, 3}), true,
                    0.75, LabelCode{3000}}};
  truth.stuff = {{"mug", "", Se3{}, false, 0.0, LabelCode{4000}}};
  truth.events = {{"removed", "mug"}};
  return truth;
}

TEST_F(Readers, BeliefsComeBackToTheSameBytes) {
  BeliefState next = belief_of_a_kitchen();
  next.frame = FrameIndex{5};
  next.floor.reset();
  next.segmented_with = kPriorFrame;
  next.stuff[0].joined_ids = {3, 5};
  std::string const lines = belief_line() + "\n\n" + belief_json(summary_of(next)) + "\n";
  write_text(path(), lines);
  std::vector<BeliefSummary> const beliefs = read_beliefs(path());
  ASSERT_EQ(beliefs.size(), 2U);
  EXPECT_EQ(belief_json(beliefs[0]) + "\n\n" + belief_json(beliefs[1]) + "\n", lines);
}

// Infinite log-odds are null in JSON.
TEST_F(Readers, LogOddsComeBackToTheBit) {
  BeliefState belief = belief_of_a_kitchen();
  belief.floor->log_odds = 1.0 / 3.0;
  belief.walls[0].log_odds = -4.6;
  belief.objects[0].log_odds = -std::numeric_limits<double>::infinity();
  belief.stuff[0].log_odds = 40.0;
  write_text(path(), belief_json(summary_of(belief)) + "\n");
  BeliefSummary const read = read_beliefs(path()).at(0);
  EXPECT_EQ(read.floor->log_odds, belief.floor->log_odds);
  EXPECT_EQ(read.floor->probability, probability_of(1.0 / 3.0));
  EXPECT_EQ(read.floor->evidence, Evidence::kOccluded);
  EXPECT_EQ(read.walls[0].log_odds, belief.walls[0].log_odds);
  EXPECT_EQ(read.objects[0].log_odds, belief.objects[0].log_odds);
  EXPECT_EQ(read.stuff[0].log_odds, belief.stuff[0].log_odds);
  EXPECT_EQ(read.stuff[0].why->points, belief.stuff[0].why.points);
  EXPECT_EQ(read.stuff[0].why->moved, belief.stuff[0].why.moved);
}

// Lines of before there was a why: nothing of it is made up.
TEST_F(Readers, OlderBeliefsStayAsTheyAre) {
  BeliefSummary old = summary_of(belief_of_a_kitchen());
  old.objects[0].probability = 0.9;
  old.floor->why.reset();
  old.walls[0].why.reset();
  old.objects[0].why.reset();
  old.stuff[0].why.reset();
  std::string const line = belief_json(old);
  EXPECT_THAT(line, Not(HasSubstr("why")));
  EXPECT_THAT(line, Not(HasSubstr("log_odds")));
  EXPECT_THAT(line, HasSubstr("\"points\":2},\"walls\""));
  write_text(path(), line + "\n");
  BeliefSummary const read = read_beliefs(path()).at(0);
  EXPECT_EQ(belief_json(read), line);
  EXPECT_FALSE(read.floor->why || read.walls[0].why || read.objects[0].why || read.stuff[0].why);
  EXPECT_NEAR(read.objects[0].log_odds, std::log(9.0), 1e-12);
}

TEST_F(Readers, TruthComesBackToTheSameBytes) {
  std::string const line = truth_json(kitchen_truth());
  write_text(path(), line + "\n");
  std::vector<FrameTruth> const frames = read_truth(path());
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(truth_json(frames[0]), line);
}

TEST_F(Readers, ATruthMayTellLittle) {
  write_text(path(),
             R"({"frame":0,"stamp_ns":5,"T_world_camera":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})");
  std::vector<FrameTruth> const frames = read_truth(path());
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_FALSE(frames[0].floor);
  EXPECT_TRUE(frames[0].walls.empty() && frames[0].objects.empty() && frames[0].events.empty());
}

TEST_F(Readers, WhatIsNoBeliefIsToldByItsLine) {
  std::string const good = belief_line();
  auto const error = [&](std::string const& second) {
    return error_of(good + "\n" + second + "\n", read_beliefs);
  };
  std::string const later = replaced(good, "\"frame\":3", "\"frame\":4");
  EXPECT_EQ(error(later), "no error");
  EXPECT_EQ(error(good), "2: frame: must come after 3");
  EXPECT_EQ(error(later.substr(0, 40)), "2: is not JSON from character 41 on");
  EXPECT_EQ(error_of(good + "\n" + later.substr(0, 40), read_beliefs),
            "2: is not JSON from character 41 on: the file was cut short; without this line the "
            "rest can be read");
  EXPECT_EQ(error_of(good + "\nx", read_beliefs), "2: is not JSON from character 1 on");
  EXPECT_EQ(error(replaced(later, "\"schema\":1", "\"schema\":2")),
            "2: schema: only 1 is known: written by another version of credo?");
  EXPECT_EQ(error(replaced(later, "\"probability\":0.5", "\"probability\":1.5")),
            "2: floor.probability: must be in [0, 1]");
  EXPECT_EQ(error(replaced(later, "\"seen_through\",", "\"smelt\",")),
            "2: objects[0].evidence: 'smelt' is no evidence");
  EXPECT_EQ(error(replaced(later, "\"agrees\":30", "\"agrees\":-1")),
            "2: objects[0].why.agrees: must be a whole number, 0 or above");
  EXPECT_EQ(error(replaced(later, "\"log_odds\":0.0,", "")), "2: floor.log_odds: is missing");
  EXPECT_EQ(error(replaced(later, "\"history\":3", "\"history\":-3")),
            "2: stuff[0].history: must be a whole number, 0 or above");
  EXPECT_EQ(error(replaced(later, "[[5.0,-1.0],[5.0,1.5]]", "[[5.0,-1.0]]")),
            "2: walls[0].segment: must be two points");
  EXPECT_EQ(error(replaced(later, "\"height_m\"", "\"height\"")), "2: floor.height_m: is missing");
}

TEST_F(Readers, WhatIsNoTruthIsToldByItsLine) {
  std::string const good = truth_json(kitchen_truth());
  auto const error = [&](std::string const& line) { return error_of(line + "\n", read_truth); };
  EXPECT_EQ(error(good), "no error");
  EXPECT_EQ(error(replaced(good, "removed", "vanished")),
            "1: events[0].what: must be appeared, moved or removed");
  EXPECT_EQ(error(replaced(good, "\"present\":true", "\"present\":1")),
            "1: objects[0].present: must be true or false");
  EXPECT_EQ(error(replaced(good, "\"label\":3000", "\"label\":70000")),
            "1: objects[0].label: must be a whole number, 0 or above");
  EXPECT_THAT(error(replaced(good, "\"T_world_camera\":[", "\"T_world_camera\":[9.5,")),
              HasSubstr("1: T_world_camera: must be 16 numbers, has 17"));
}

TEST_F(Readers, AFileThatIsNotThereIsTold) {
  try {
    read_beliefs(folder_ / "none.jsonl");
    FAIL();
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(), EndsWith("none.jsonl: beliefs cannot be read"));
  }
}

}  // namespace
}  // namespace credo::test
