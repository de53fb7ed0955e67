// Who may know whom: core <- geometry <- stages <- graph <- tools; config, io know core; sim, eval
// and openni know core, geometry, io. This test reads the includes and holds the rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/paths.hpp"

namespace {

namespace fs = std::filesystem;

struct Include {
  fs::path file;  // relative to src/
  std::string target;
};

std::vector<Include> includes_of(fs::path const& root) {
  static std::regex const pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> found;
  for (auto const& entry : fs::recursive_directory_iterator(root)) {
    auto const extension = entry.path().extension();
    if (extension != ".hpp" && extension != ".cpp") {
      continue;
    }
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (std::regex_search(line, match, pattern)) {
        found.push_back({fs::relative(entry.path(), root), match[1]});
      }
    }
  }
  return found;
}

/// "stages/normals" for a stage, else the first folder.
std::string room_of(fs::path const& path) {
  auto part = path.begin();
  std::string room = part->string();
  return room == "stages" ? room + "/" + std::next(part)->string() : room;
}

std::vector<std::string> const& allowed_rooms(std::string const& room) {
  static std::map<std::string, std::vector<std::string>> const allowed = {
      {"core", {"core"}},
      {"geometry", {"core", "geometry"}},
      {"config", {"core", "config"}},
      {"io", {"core", "io"}},
      {"openni", {"core", "geometry", "io", "openni"}},
      {"drivers", {"core", "geometry", "io", "drivers"}},
      {"dds", {"core", "dds"}},
      {"sim", {"core", "geometry", "io", "sim"}},
      {"eval", {"core", "geometry", "io", "eval"}},
      {"history", {"core", "io", "history"}},
      {"stages", {"core", "geometry", "stages"}},
      {"detector", {"core", "geometry", "io", "stages", "detector"}},
      {"doctor", {"core", "geometry", "openni", "dds", "stages", "doctor"}},
      {"graph", {"core", "geometry", "stages", "graph", "io"}},
  };
  auto const found = allowed.find(room);
  static std::vector<std::string> const none;
  return found == allowed.end() ? none : found->second;
}

std::set<std::string> const& rooms() {
  static std::set<std::string> const all = {"core",    "geometry", "config",  "io",      "sim",
                                            "eval",    "stages",   "graph",   "dds",     "openni",
                                            "drivers", "doctor",   "history", "detector"};
  return all;
}

TEST(Dependencies, EachRoomKnowsOnlyTheRoomsBelowIt) {
  auto const includes = includes_of(credo::test::source_folder() / "src");
  ASSERT_GT(includes.size(), 100U);
  for (Include const& include : includes) {
    std::string const from = include.file.begin()->string();
    std::string const to = fs::path(include.target).begin()->string();
    if (rooms().count(to) == 0) {
      continue;
    }
    EXPECT_THAT(allowed_rooms(from), testing::Contains(to))
        << include.file << " includes " << include.target;
  }
}

TEST(Dependencies, AStageNeverIncludesAnotherStage) {
  for (Include const& include : includes_of(credo::test::source_folder() / "src")) {
    if (room_of(include.file).starts_with("stages/") && include.target.starts_with("stages/")) {
      EXPECT_EQ(room_of(include.file), room_of(include.target)) << include.file;
    }
  }
}

TEST(Dependencies, LibrariesStayInTheirRooms) {
  struct Rule {
    std::string prefix;
    std::vector<std::string> rooms;
    bool headers;  // whether a header may include it
  };
  std::vector<Rule> const rules = {
      {"tbb/flow_graph.h", {"graph"}, true},
      {"oneapi/tbb/flow_graph.h", {"graph"}, true},
      {"yaml-cpp/", {"config"}, false},
      {"pcl/", {"io", "geometry", "stages", "detector"}, false},
      {"embree", {"geometry", "sim"}, false},
      {"spdlog/", {"graph"}, true},
      {"assimp/", {"io"}, false},
      {"spng.h", {"io"}, false},
      {"openssl/", {"io"}, false},
      {"turbojpeg.h", {"io"}, false},
      {"nlohmann/", {"io"}, true},
      {"OpenNI.h", {"openni"}, false},
      {"Driver/OniDriverAPI.h", {"drivers"}, true},
      {"libfreenect", {"drivers"}, true},
      {"dds/dds.h", {"dds"}, true},
      {"belief.h", {"dds"}, true},
      {"things.h", {"dds"}, false},
      {"segmentation.h", {"dds"}, false},
      {"metrics.h", {"dds"}, false},
      {"detector.h", {"dds"}, true},
  };
  for (Include const& include : includes_of(credo::test::source_folder() / "src")) {
    for (Rule const& rule : rules) {
      if (!include.target.starts_with(rule.prefix)) {
        continue;
      }
      EXPECT_THAT(rule.rooms, testing::Contains(include.file.begin()->string())) << include.file;
      EXPECT_TRUE(rule.headers || include.file.extension() == ".cpp")
          << include.file << " shows " << include.target << " to whoever includes it";
    }
  }
}

/// The folder whose list a test is in: its own, or the nearest above that has one.
fs::path listed_in(fs::path const& test) {
  fs::path folder = test.parent_path();
  while (!fs::exists(folder / "CMakeLists.txt")) {
    folder = folder.parent_path();
  }
  return folder;
}

// A suite whose folder no list names is never built, and nobody misses it.
TEST(Dependencies, EverySuiteIsBuilt) {
  fs::path const tests = credo::test::source_folder() / "tests";
  for (auto const& entry : fs::recursive_directory_iterator(tests)) {
    fs::path const folder = entry.path().parent_path();
    if (entry.path().filename() == "CMakeLists.txt" && folder != tests) {
      std::ifstream file(folder.parent_path() / "CMakeLists.txt");
      std::string const list(std::istreambuf_iterator<char>(file), {});
      EXPECT_THAT(list, testing::ContainsRegex("[ (]" + folder.filename().string() + "[ )]"));
    }
    if (entry.path().filename().string().ends_with("_test.cpp")) {
      EXPECT_NE(listed_in(entry.path()), tests) << entry.path();
    }
  }
}

TEST(Dependencies, EverySourceOfASuiteIsBuilt) {
  for (auto const& entry :
       fs::recursive_directory_iterator(credo::test::source_folder() / "tests")) {
    fs::path const folder = listed_in(entry.path());
    std::string const name = fs::relative(entry.path(), folder).string();
    if (name.ends_with("_test.cpp")) {
      std::ifstream file(folder / "CMakeLists.txt");
      std::string const list(std::istreambuf_iterator<char>(file), {});
      std::string const stem = name.substr(0, name.size() - std::string("_test.cpp").size());
      // Some lists name the subject, and make the file's name of it.
      EXPECT_THAT(list, testing::ContainsRegex("[ (]" + stem + "(_test.cpp)?[ )\n]"))
          << entry.path();
    }
  }
}

TEST(Dependencies, FilesStayReadable) {
  for (char const* room : {"src", "tools", "tests", "bench"}) {
    for (auto const& entry :
         fs::recursive_directory_iterator(credo::test::source_folder() / room)) {
      auto const extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") {
        continue;
      }
      std::ifstream file(entry.path());
      int lines = 0;
      for (std::string line; std::getline(file, line);) {
        ++lines;
      }
      EXPECT_LE(lines, 400) << entry.path() << " is too long: split it";
    }
  }
}

}  // namespace
