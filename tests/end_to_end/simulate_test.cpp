// A scene as a dataset: the same run as from the scene itself, with the truth beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/label.hpp"
#include "end_to_end/program.hpp"
#include "io/image.hpp"

namespace credo::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class Simulate : public ::testing::Test {
protected:
  Ended simulate(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"simulate", "bottle-moves",
                                          "--out",    (folder_ / "data").string(),
                                          "--set",    "sim.sensor=disparity"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return credo(arguments);
  }
  std::vector<std::string> beliefs_of(std::string const& source, std::string const& name) {
    Ended const run = credo({"run", "--source", source, "--no-dds", "--set", "sim.sensor=disparity",
                             "--out", (folder_ / name).string()});
    EXPECT_EQ(run.code, 0) << run.err;
    return read_lines(folder_ / name / "belief.jsonl");
  }

  TempFolder folder_;
};

TEST_F(Simulate, ReadsBackToTheSameBytes) {
  Ended const ended = simulate({});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("6 frames of bottle-moves in "));
  std::vector<std::string> const played = beliefs_of("sim:bottle-moves", "played");
  ASSERT_EQ(played.size(), 6U);
  EXPECT_EQ(beliefs_of("dataset:" + (folder_ / "data").string(), "read"), played);
}

TEST_F(Simulate, WritesWhatIsTrue) {
  ASSERT_EQ(simulate({}).code, 0);
  std::vector<std::string> const lines = read_lines(folder_ / "data/truth.jsonl");
  ASSERT_EQ(lines.size(), 6U);
  json const before = json::parse(lines[1]);
  json const after = json::parse(lines[2]);
  EXPECT_TRUE(before["events"].empty());
  EXPECT_EQ(after["events"], json::parse(R"([{"what": "moved", "id": "bottle"}])"));
  EXPECT_EQ(before["stuff"][0]["id"], "bottle");
  EXPECT_EQ(before["stuff"][0]["position"], json::parse("[2.0, 0.0, 0.72]"));
  EXPECT_EQ(after["stuff"][0]["position"], json::parse("[2.0, -0.4, 0.72]"));
  EXPECT_EQ(after["objects"][0]["id"], "table");
  EXPECT_EQ(after["floor"]["label"], 1000);
  Grid<std::uint16_t> const labels = read_png16(folder_ / "data/truth/000002.png");
  std::set<int> const codes(labels.begin(), labels.end());
  EXPECT_EQ(codes, (std::set<int>{0, 1000, 2000, 3000, 4000}));
}

TEST_F(Simulate, WhatWalksIsTrueInEachFrame) {
  Ended const ended =
      credo({"simulate", "corridor-loop", "--frames", "3", "--out", (folder_ / "walk").string()});
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::vector<std::string> const lines = read_lines(folder_ / "walk/truth.jsonl");
  ASSERT_EQ(lines.size(), 3U);
  std::vector<double> x;
  json person;
  for (std::string const& line : lines) {
    json const stuff = json::parse(line)["stuff"];
    person = *std::find_if(stuff.begin(), stuff.end(),
                           [](json const& thing) { return thing["id"] == "first person"; });
    x.push_back(person["position"][0]);
  }
  EXPECT_LT(x[1], x[0]);
  EXPECT_NEAR(x[1] - x[2], x[0] - x[1], 1e-9);
  EXPECT_EQ(json::parse(lines[1])["events"],
            json::parse(R"([{"what": "moved", "id": "first person"}])"));
  EXPECT_TRUE(json::parse(lines[2])["events"].empty());
  Grid<std::uint16_t> const labels = read_png16(folder_ / "walk/truth/000002.png");
  EXPECT_GT(std::count(labels.begin(), labels.end(), person["label"].get<int>()), 100);
}

TEST_F(Simulate, TwoOfTheSameSeedAreTheSameAndOthersAreNot) {
  ASSERT_EQ(simulate({"--frames", "1"}).code, 0);
  auto const depth = [&] { return read_text(folder_ / "data/depth/000000.png"); };
  std::string const first = depth();
  std::filesystem::remove_all(folder_ / "data");
  ASSERT_EQ(simulate({"--frames", "1"}).code, 0);
  EXPECT_EQ(depth(), first);
  std::filesystem::remove_all(folder_ / "data");
  ASSERT_EQ(simulate({"--frames", "1", "--set", "sim.seed=2"}).code, 0);
  EXPECT_NE(depth(), first);
}

TEST_F(Simulate, BadUsageIsOneLine) {
  ASSERT_EQ(simulate({"--frames", "1"}).code, 0);
  Ended const twice = simulate({});
  EXPECT_EQ(twice.code, 2);
  EXPECT_EQ(twice.err, "credo: " + (folder_ / "data").string() +
                           ": holds a dataset already; name another folder\n");
  Ended const nowhere = credo({"simulate", "nowhere", "--out", (folder_ / "x").string()});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("nowhere: no such scene or file; scenes are "));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x"));
}

}  // namespace
}  // namespace credo::test
