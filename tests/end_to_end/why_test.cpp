// credo why on a simulated run: what a belief's accounts say is what happened; what cannot be
// answered is told in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A table with things that are hidden, moved and taken away; and a copy that tests may spoil.
class Why : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    folder() = new TempFolder();
    Ended const ended = credo({"run", "--source", "sim:swap-and-occlude", "--no-dds", "--out",
                               (*folder() / "run").string()});
    ASSERT_EQ(ended.code, 0) << ended.err;
  }
  static void TearDownTestSuite() {
    delete folder();
    folder() = nullptr;
  }
  static TempFolder*& folder() {
    static TempFolder* folder = nullptr;
    return folder;
  }
  static std::string run() { return (*folder() / "run").string(); }
  static std::vector<json> beliefs() {
    std::vector<json> beliefs;
    for (std::string const& line : read_lines(*folder() / "run/belief.jsonl")) {
      beliefs.push_back(json::parse(line));
    }
    return beliefs;
  }
  /// The one line of a folder with this belief.jsonl that is refused.
  std::string refusal(std::string const& text, std::string const& id = "") {
    fs::create_directories(spoiled_ / "run");
    write_text(spoiled_ / "run/belief.jsonl", text);
    return refusal_of({(spoiled_ / "run").string(), id});
  }
  static std::string refusal_of(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "why");
    std::erase(arguments, "");
    Ended const ended = credo(arguments);
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    return ended.err;
  }

  TempFolder spoiled_;
};

/// The items of one kind, by id.
std::map<std::string, json> items_of(json const& belief, char const* kind) {
  std::map<std::string, json> items;
  for (json const& item : belief[kind]) {
    items[item["id"].dump()] = item;
  }
  return items;
}

// From an item's first log-odds on, the sum of what moved them is what they are.
TEST_F(Why, MovedAddsUpToTheLogOddsOfEachPieceOfStuff) {
  std::map<std::string, double> sums;
  std::set<std::string> evidences;
  int moves = 0;
  for (json const& belief : beliefs()) {
    for (auto const& [id, item] : items_of(belief, "stuff")) {
      double const log_odds = item["log_odds"];
      double const moved = item["why"]["moved"];
      evidences.insert(item["evidence"].get<std::string>());
      moves += moved != 0.0 ? 1 : 0;
      auto const [sum, is_new] = sums.try_emplace(id, log_odds);
      if (is_new) {
        EXPECT_EQ(moved, 0.0) << "new in frame " << belief["frame"] << ": " << id;
      } else {
        sum->second += moved;
      }
      EXPECT_NEAR(sum->second, log_odds, 1e-9) << "frame " << belief["frame"] << ": " << id;
      EXPECT_NEAR(item["probability"], 1.0 / (1.0 + std::exp(-log_odds)), 1e-12);
      if (item["evidence"] != "seen" && item["evidence"] != "seen_through") {
        EXPECT_EQ(moved, 0.0);
      }
    }
  }
  EXPECT_GT(sums.size(), 2U);
  EXPECT_GT(moves, 50);
  EXPECT_TRUE(evidences.contains("seen") && evidences.contains("occluded")) << "or it says little";
}

TEST_F(Why, EveryItemOfABeliefTellsWhy) {
  for (json const& belief : beliefs()) {
    std::vector<json> items;
    for (char const* kind : {"walls", "objects", "stuff"}) {
      items.insert(items.end(), belief[kind].begin(), belief[kind].end());
    }
    if (!belief["floor"].is_null()) {
      items.push_back(belief["floor"]);
    }
    ASSERT_FALSE(items.empty());
    for (json const& item : items) {
      EXPECT_TRUE(item.contains("probability") && item.contains("evidence")) << item;
      EXPECT_TRUE(item["log_odds"].is_number());
      for (char const* key : {"agrees", "occluded", "seen_through", "no_depth", "out_of_view"}) {
        EXPECT_TRUE(item["why"].at(key).is_number_unsigned()) << key;
      }
      for (char const* key : {"visible_share", "news", "moved"}) {
        EXPECT_TRUE(item["why"].at(key).is_number()) << key;
      }
      EXPECT_TRUE(item["why"].at("bounded").is_boolean());
    }
  }
}

TEST_F(Why, WithoutAnIdListsEverythingByWhatMovedMost) {
  Ended const text = credo({"why", run()});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.err, "");
  EXPECT_THAT(text.out, HasSubstr("what happened last"));
  json const things = json::parse(credo({"why", run(), "--json"}).out);
  std::set<std::string> expected;
  for (json const& belief : beliefs()) {
    for (json const& item : belief["stuff"]) {
      expected.insert("stuff:" + item["id"].dump());
    }
  }
  std::set<std::string> listed;
  double last = 1e9;
  for (json const& thing : things) {
    EXPECT_LE(thing["travelled"].get<double>(), last);
    last = thing["travelled"];
    EXPECT_THAT(text.out, HasSubstr("\n  " + thing["id"].get<std::string>() + " "));
    if (thing["kind"] == "stuff") {
      listed.insert(thing["id"].get<std::string>());
    }
  }
  EXPECT_EQ(listed, expected);
  EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'),
            static_cast<std::ptrdiff_t>(things.size()) + 1);
}

TEST_F(Why, WithAnIdTellsItsHistory) {
  Ended const text = credo({"why", run(), "1"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, StartsWith("stuff:1: a thing that nobody told of\n  first in frame "));
  EXPECT_THAT(text.out, HasSubstr("of its points [%]"));
  EXPECT_EQ(text.out, credo({"why", run(), "stuff:1"}).out);
  json const thing = json::parse(credo({"why", run(), "1", "--json"}).out);
  std::vector<json> moments;
  for (json const& belief : beliefs()) {
    auto const items = items_of(belief, "stuff");
    if (auto const found = items.find("1"); found != items.end()) {
      moments.push_back(found->second);
    }
  }
  double moved = 0.0;
  std::size_t frames = 0;
  for (json const& span : thing["spans"]) {
    moved += span["moved"].get<double>();
    for (auto frame = span["frames"][0].get<std::size_t>(); frame <= span["frames"][1]; ++frame) {
      EXPECT_EQ(span["evidence"], moments.at(frames++)["evidence"]);
    }
  }
  EXPECT_EQ(frames, moments.size());
  EXPECT_NEAR(moments.front()["log_odds"].get<double>() + moved, moments.back()["log_odds"], 1e-9);
  EXPECT_EQ(thing["probability"], moments.back()["probability"]);
}

TEST_F(Why, DrawsItToo) {
  fs::path const plot = spoiled_ / "1.svg";
  Ended const ended = credo({"why", run(), "1", "--plot", plot.string()});
  EXPECT_EQ(ended.code, 0) << ended.err;
  std::string const svg = read_text(plot);
  EXPECT_THAT(svg, StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr("stuff:1: probability that it is there"));
  EXPECT_THAT(svg, HasSubstr(">bound<")) << "of the run's config";
  EXPECT_THAT(refusal_of({run(), "1", "--plot", "/nowhere/1.svg"}), HasSubstr("/nowhere/1.svg"));
}

TEST_F(Why, AnIdThatIsNotThereIsToldWithWhatIsNear) {
  EXPECT_EQ(refusal_of({run(), "chair"}).find("credo: " + run() + ": the run has no chair; near "),
            0U);
  EXPECT_THAT(refusal_of({run(), "999"}), HasSubstr("the run has no 999; near that: stuff:"));
}

TEST_F(Why, WhatIsNoRunIsToldInOneLine) {
  EXPECT_EQ(refusal_of({"/nowhere"}),
            "credo: /nowhere: no run: it has no belief.jsonl (credo run --out writes it)\n");
  std::string const name = (spoiled_ / "run/belief.jsonl").string();
  EXPECT_EQ(refusal(""), "credo: " + name + ": holds no belief: the run had no good frame\n");
  std::vector<json> all = beliefs();
  std::string const good = all[0].dump() + "\n";
  EXPECT_EQ(refusal(good + all[1].dump().substr(0, 50)),
            "credo: " + name +
                ":2: is not JSON from character 51 on: the file was cut short; without this line "
                "the rest can be read\n");
  for (json& stuff : all[1]["stuff"]) {
    stuff.erase("why");
    stuff.erase("log_odds");
  }
  EXPECT_EQ(refusal(good + all[1].dump() + "\n", "1"),
            "credo: " + name +
                ": frame 1 does not tell why: it was written by an older version of credo, or is "
                "no run's; run it again\n");
  json nothing = all[0];
  nothing["floor"] = nullptr;
  nothing["walls"] = nothing["objects"] = nothing["stuff"] = json::array();
  EXPECT_EQ(refusal(nothing.dump() + "\n", "1"),
            "credo: " + (spoiled_ / "run").string() + ": the run never believed anything\n");
}

}  // namespace
}  // namespace credo::test
