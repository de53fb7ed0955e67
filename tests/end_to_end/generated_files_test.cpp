// The files that the program writes about itself are what it would write today: `make docs`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "support/paths.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;
using test::Ended;

fs::path const kRoot = test::source_folder();

/// A file of the project is what the program prints; told by the first line that is not.
void expect_printed(fs::path const& file, std::vector<std::string> const& arguments) {
  test::TempFolder const folder;
  Ended const ended = test::credo(arguments);
  ASSERT_EQ(ended.code, 0) << ended.err;
  ASSERT_NE(ended.out, "");
  test::write_text(folder / "printed", ended.out);
  std::vector<std::string> committed = test::read_lines(kRoot / file);
  std::vector<std::string> printed = test::read_lines(folder / "printed");
  std::size_t const lines = std::max(committed.size(), printed.size());
  committed.resize(lines);
  printed.resize(lines);
  for (std::size_t i = 0; i < lines; ++i) {
    ASSERT_EQ(committed[i], printed[i])
        << file << ":" << i + 1 << " is not what the program prints: run `make docs`";
  }
}

TEST(GeneratedFiles, DefaultYamlIsWhatConfigPrints) {
  expect_printed("config/default.yaml", {"config"});
}

TEST(GeneratedFiles, ConfigPageIsWhatConfigPrints) {
  expect_printed("docs/config.md", {"config", "--markdown"});
}

TEST(GeneratedFiles, EveryFileInConfigResolvesAndTheOverlaysSaySomething) {
  std::string const defaults = test::credo({"config"}).out;
  for (auto const& entry : fs::directory_iterator(kRoot / "config")) {
    if (entry.path().extension() != ".yaml") {
      continue;  // of the DDS
    }
    Ended const ended = test::credo({"config", "--config", entry.path().string()});
    EXPECT_EQ(ended.code, 0) << ended.err;
    if (entry.path().filename() != "default.yaml") {
      EXPECT_NE(ended.out, defaults) << entry.path();
    }
  }
}

}  // namespace
}  // namespace credo
