// docs/thesis-results.md is what the program gives today: `make thesis-results`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "support/paths.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::SizeIs;

fs::path page() {
  return source_folder() / "docs/thesis-results.md";
}

/// The parts of the page about one figure each.
std::vector<std::string> sections() {
  std::string const text = read_text(page());
  std::vector<std::string> parts;
  std::size_t begin = text.find("\n## ");
  while (begin != std::string::npos) {
    std::size_t const end = text.find("\n## ", begin + 1);
    parts.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return parts;
}

/// The arguments of the first command in a section, as a shell in the project's folder reads them;
/// files by their full paths, and nothing to draw.
std::vector<std::string> arguments_in(std::string const& section, fs::path const& out) {
  std::size_t const begin = section.find("build/bin/credo run");
  std::istringstream words(section.substr(begin, section.find("\n```", begin) - begin));
  std::vector<std::string> arguments;
  std::string open;  // a quoted word so far
  for (std::string word; words >> word;) {
    open += (open.empty() ? "" : " ") + word;
    if (std::ranges::count(open, '\'') % 2 != 0) {
      continue;
    }
    std::erase(open, '\'');
    if (open != "\\" && open != "build/bin/credo") {
      bool const is_file = open.ends_with(".yaml");
      arguments.push_back(is_file ? (source_folder() / open).string() : open);
    }
    open.clear();
  }
  auto const dump = std::ranges::find(arguments, "--dump");
  arguments.erase(dump, dump == arguments.end() ? dump : dump + 2);
  *(std::ranges::find(arguments, "--out") + 1) = out.string();
  return arguments;
}

TEST(ThesisResults, ThePageIsWhatTheRunsGive) {
  TempFolder const folder;
  Program program({CREDO_THESIS_RESULTS, (folder / "page.md").string()});
  Ended const ended = program.wait();
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::vector<std::string> committed = read_lines(page());
  std::vector<std::string> printed = read_lines(folder / "page.md");
  std::size_t const lines = std::max(committed.size(), printed.size());
  committed.resize(lines);
  printed.resize(lines);
  for (std::size_t i = 0; i < lines; ++i) {
    ASSERT_EQ(committed[i], printed[i])
        << page() << ":" << i + 1 << " is not what the runs give: run `make thesis-results`";
  }
}

TEST(ThesisResults, EveryFigureIsThere) {
  ASSERT_THAT(sections(), SizeIs(9));
  for (std::string const& section : sections()) {
    std::size_t const begin = section.find("](thesis/") + 2;
    fs::path const picture = section.substr(begin, section.find(')', begin) - begin);
    EXPECT_TRUE(fs::is_regular_file(page().parent_path() / picture)) << picture;
  }
}

// The page is made without the command line; a reader has nothing else.
TEST(ThesisResults, TheCommandsOnThePageGiveItsNumbers) {
  for (std::string const& section : sections()) {
    TempFolder const folder;
    Ended const ended = credo(arguments_in(section, folder / "out"));
    ASSERT_EQ(ended.code, 0) << section.substr(0, 40) << ended.err;
    std::string floor = "| red | floor, points |";
    std::string walls = "| pink | walls |";
    for (std::string const& line : read_lines(folder / "out/belief.jsonl")) {
      json const belief = json::parse(line);
      double const points = belief["floor"]["points"];
      floor += " " + std::to_string(std::lround(points / 100) * 100) + " |";
      walls += " " + std::to_string(belief["walls"].size()) + " |";
    }
    if (section.find("| red |") != std::string::npos) {  // chapter 4
      EXPECT_THAT(section, HasSubstr(floor));
      EXPECT_THAT(section, HasSubstr(walls));
    }
  }
}

}  // namespace
}  // namespace credo::test
