// The texts of config errors are part of the interface: people read them, scripts match them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/kitchen_config.hpp"
#include "config/yaml_config.hpp"
#include "core/error.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ConfigErrors : public testing::Test {
protected:
  /// What loading says, with the file's name as FILE; empty where it is content.
  std::string load(std::string const& yaml) {
    auto const path = folder_ / "a.yaml";
    write_text(path, yaml);
    std::string text = load({path}, {});
    for (std::size_t at = 0; (at = text.find(path.string())) != std::string::npos;) {
      text.replace(at, path.string().size(), "FILE");
    }
    return text;
  }

  std::string set(std::string const& override_text) { return load({}, {override_text}); }

  std::string load(std::vector<std::filesystem::path> const& files,
                   std::vector<std::string> const& overrides) {
    try {
      load_config(fields(config_), files, overrides);
    } catch (InputError const& error) {
      return error.what();
    }
    return {};
  }

  TempFolder folder_;
  KitchenConfig config_;
};

struct Golden {
  std::string yaml;
  std::string error;
};

class ConfigErrorText : public ConfigErrors, public testing::WithParamInterface<Golden> {};

TEST_P(ConfigErrorText, IsGolden) {
  EXPECT_EQ(load(GetParam().yaml), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Numbers, ConfigErrorText,
    testing::Values(
        Golden{"normals:\n  max_jump_m: 2.0\n",
               "FILE:2:3: normals.max_jump_m = 2.0: must be in [0, 0.1] m"},
        Golden{"gain: -1\n", "FILE:1:1: gain = -1: must be at least 0"},
        Golden{"gain: inf\n", "FILE:1:1: gain = inf: must be at least 0"},
        Golden{"gain: nan\n", "FILE:1:1: gain = nan: must be at least 0"},
        Golden{"gain: .nan\n", "FILE:1:1: gain = .nan: must be a number"},
        Golden{"gain: 1e999\n", "FILE:1:1: gain = 1e999: must be a number"},
        Golden{"gain: loud\n", "FILE:1:1: gain = loud: must be a number"},
        Golden{"gain: 1,5\n", "FILE:1:1: gain = 1,5: must be a number"},
        Golden{"gain: +-5\n", "FILE:1:1: gain = +-5: must be a number"},
        Golden{"gain: 010\n", "FILE:1:1: gain = 010: must be a number without leading zeros"},
        Golden{"gain:\n", "FILE:1:1: gain: must be a single value"},
        Golden{"gain: [1]\n", "FILE:1:1: gain: must be a single value"},
        Golden{"any_number: 010\n",
               "FILE:1:1: any_number = 010: must be a whole number without leading zeros"},
        Golden{"any_number: 0x10\n", "FILE:1:1: any_number = 0x10: must be a whole number"},
        Golden{"any_number: 1.0\n", "FILE:1:1: any_number = 1.0: must be a whole number"},
        Golden{"any_number: 4294967297\n",
               "FILE:1:1: any_number = 4294967297: must be a whole number of at most 32 bits"},
        Golden{"normals: {window_px: 4294967305}\n",
               "FILE:1:11: normals.window_px = 4294967305: must be in [3, 99] px"}));

INSTANTIATE_TEST_SUITE_P(
    WordsAndLists, ConfigErrorText,
    testing::Values(
        Golden{"normals: {enabled: yes}\n",
               "FILE:1:11: normals.enabled = yes: must be true or false"},
        Golden{"normals: {enabled: 1}\n", "FILE:1:11: normals.enabled = 1: must be true or false"},
        Golden{"pace: quick\n", "FILE:1:1: pace = quick: must be one of off, slow, fast"},
        Golden{"position: [1, 2]\n", "FILE:1:1: position: must be a list of 3 numbers"},
        Golden{"position: 1\n", "FILE:1:1: position: must be a list of 3 numbers"},
        Golden{"position: [1, two, 3]\n", "FILE:1:1: position[1] = two: must be a number"},
        Golden{"position: [1, .inf, 3]\n", "FILE:1:1: position[1] = .inf: must be a number"},
        Golden{"things: 3\n", "FILE:1:1: things: must be a list"},
        Golden{"things:\n  - name: a\n  - size_m: [1, 2, 3, 4]\n",
               "FILE:3:5: things[1].size_m: must be a list of 1 to 3 numbers"},
        Golden{"things:\n  - size_m: [11]\n",
               "FILE:2:5: things[0].size_m[0] = 11: must be in [0, 10] m"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, ConfigErrorText,
    testing::Values(Golden{"normals:\n  windw_px: 5\n",
                           "FILE:2:3: unknown key normals.windw_px (did you mean window_px?)"},
                    Golden{"zzzzzz: 5\n", "FILE:1:1: unknown key zzzzzz"},
                    Golden{"gain: 1\nfile: a\ngain: 2\n", "FILE:3:1: duplicate key gain"},
                    Golden{"normals:\n  window_px: 5\nnormals:\n  window_px: 7\n",
                           "FILE:3:1: duplicate key normals"},
                    Golden{"normals: 5\n", "FILE:1:10: normals: must be a map of keys"},
                    Golden{"just words\n", "FILE:1:1: the file: must be a map of keys"},
                    Golden{"gain: 1\n---\ngain: 2\n", "FILE: must be one YAML document, not 2"}));

TEST_F(ConfigErrors, MalformedYamlSaysWhere) {
  EXPECT_THAT(load("gain: 1\nfile: [1, 2\n"),
              testing::MatchesRegex("FILE:[0-9]+:[0-9]+: not YAML: .+"));
  EXPECT_THAT(load("gain: 1\n\tfile: a\n"), StartsWith("FILE:2:1: not YAML: "));
}

TEST_F(ConfigErrors, AreAllToldAtOnceInOrderOfFilesThenOverrides) {
  write_text(folder_ / "a.yaml", "gain: x\npaec: slow\n");
  write_text(folder_ / "b.yaml", "any_number: 1.5\n");
  std::string const a = (folder_ / "a.yaml").string();
  std::string const b = (folder_ / "b.yaml").string();
  EXPECT_EQ(load({a, b}, {"gain=-1"}), a + ":1:1: gain = x: must be a number\n" +  //
                                           a + ":2:1: unknown key paec (did you mean pace?)\n" + b +
                                           ":1:1: any_number = 1.5: must be a whole number\n" +
                                           "--set gain=-1: gain = -1: must be at least 0");
}

TEST_F(ConfigErrors, MissingFilesAndFoldersAreNamed) {
  std::string const missing = (folder_ / "none.yaml").string();
  EXPECT_EQ(load({missing}, {}), missing + ": cannot be read");
  EXPECT_EQ(load({folder_.path()}, {}),
            folder_.path().string() + ": is a folder, not a config file");
}

TEST_F(ConfigErrors, OverridesAreCheckedAlike) {
  EXPECT_EQ(set("normals.window_px=2"),
            "--set normals.window_px=2: normals.window_px = 2: must be in [3, 99] px");
  EXPECT_EQ(set("normals.windw_px=5"),
            "--set normals.windw_px=5: unknown key normals.windw_px (did you mean window_px?)");
  EXPECT_EQ(set("gain"), "--set gain: must be key.path=value");
  for (std::string const text : {"=1", ".gain=1", "gain.=1", "normals..window_px=5"}) {
    EXPECT_EQ(set(text), "--set " + text + ": must be key.path=value");
  }
  EXPECT_EQ(set("normals=1"), "--set normals=1: normals: must be a map of keys");
  EXPECT_THAT(set("position=[1, 2"), StartsWith("--set position=[1, 2: not YAML: "));
  EXPECT_THAT(set("gain.deeper=1"), HasSubstr("gain: must be a single value"));
}

TEST_F(ConfigErrors, ValuesThatAreRefusedChangeNothing) {
  EXPECT_NE(load("gain: -1\nany_number: 4294967297\nposition: [7, 8, x]\npace: quick\n"), "");
  EXPECT_EQ(config_.gain, 1.0);
  EXPECT_EQ(config_.any_number, 0);
  EXPECT_THAT(config_.position, testing::ElementsAre(1, 2, 3));
  EXPECT_EQ(config_.pace, Pace::kSlow);
}

}  // namespace
}  // namespace credo::test
