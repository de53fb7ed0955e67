#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "config/kitchen_config.hpp"
#include "config/yaml_config.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

class ConfigLoading : public testing::Test {
protected:
  KitchenConfig loaded(std::string const& yaml, std::vector<std::string> const& overrides = {}) {
    write_text(folder_ / "a.yaml", yaml);
    KitchenConfig config;
    load_config(fields(config), {folder_ / "a.yaml"}, overrides);
    return config;
  }
  KitchenConfig reloaded(KitchenConfig config) { return loaded(config_yaml(fields(config))); }

  TempFolder folder_;
};

TEST_F(ConfigLoading, ReadsEveryKindOfField) {
  KitchenConfig const config = loaded(R"(
normals: {window_px: 5, max_jump_m: 0.05, enabled: false}
any_number: -7
gain: +2.5
file: "kitchen #2.txt"
pace: fast
position: [0.1, -2, 3e-3]
things:
  - {name: table, size_m: [1, 2, 3]}
  - name: ball
    size_m: [0.25]
  -
)");
  EXPECT_FALSE(config.enabled);
  EXPECT_EQ(config.window_px, 5);
  EXPECT_EQ(config.max_jump_m, 0.05F);
  EXPECT_EQ(config.any_number, -7);
  EXPECT_EQ(config.gain, 2.5);
  EXPECT_EQ(config.file, "kitchen #2.txt");
  EXPECT_EQ(config.pace, Pace::kFast);
  EXPECT_THAT(config.position, testing::ElementsAre(0.1, -2.0, 3e-3));
  ASSERT_EQ(config.things.size(), 3U);
  EXPECT_EQ(config.things[0].name, "table");
  EXPECT_THAT(config.things[1].size_m, testing::ElementsAre(0.25));
  EXPECT_EQ(config.things[2].name, "thing");
}

TEST_F(ConfigLoading, LeavesAloneWhatIsNotThere) {
  for (char const* yaml : {"", "# a comment\n", "normals:\n"}) {
    EXPECT_EQ(loaded(yaml).window_px, 9);
    EXPECT_EQ(loaded(yaml).gain, 1.0);
  }
}

TEST_F(ConfigLoading, LaterFilesAndThenOverridesWin) {
  write_text(folder_ / "b.yaml", "gain: 3\nfile: b\n");
  write_text(folder_ / "a.yaml", "gain: 2\nany_number: 4\nthings: [{name: a}]\n");
  KitchenConfig config;
  load_config(fields(config), {folder_ / "a.yaml", folder_ / "b.yaml"},
              {"file=c", "normals.window_px=11", "position=[4, 5, 6]", "pace=off", "things=[]"});
  EXPECT_EQ(config.gain, 3.0);
  EXPECT_EQ(config.any_number, 4);
  EXPECT_EQ(config.file, "c");
  EXPECT_EQ(config.window_px, 11);
  EXPECT_EQ(config.pace, Pace::kOff);
  EXPECT_THAT(config.position, testing::ElementsAre(4, 5, 6));
  EXPECT_TRUE(config.things.empty());
}

TEST_F(ConfigLoading, TheEndsOfARangeAreInIt) {
  // 0.1F is a little more than the range's 0.1.
  EXPECT_EQ(loaded("normals: {max_jump_m: 0.1}").max_jump_m, 0.1F);
  EXPECT_EQ(loaded("normals: {window_px: 3}").window_px, 3);
  EXPECT_EQ(loaded("any_number: 2147483647").any_number, std::numeric_limits<int>::max());
}

TEST_F(ConfigLoading, PrintedValuesReadBackToTheBit) {
  KitchenConfig config;
  for (double const gain : {0.0, 0.1, 1.0 / 3.0, 1e300, 5e-324, std::nextafter(2.0, 3.0), 1e5}) {
    config.gain = gain;
    config.max_jump_m = static_cast<float>(0.1 * std::fmod(gain, 1.0));
    config.position = {gain, -gain, -0.0};
    KitchenConfig const back = reloaded(config);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back.gain), std::bit_cast<std::uint64_t>(gain));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(back.max_jump_m),
              std::bit_cast<std::uint32_t>(config.max_jump_m));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back.position[i]),
                std::bit_cast<std::uint64_t>(config.position[i]));
    }
  }
}

TEST_F(ConfigLoading, PrintedTextReadsBack) {
  KitchenConfig config;
  for (char const* text : {"", "plain", "with \"quotes\" and \\", "# no comment", "a: b",
                           "two\nlines", "tab\tand\x01", " spaces ", "~", "null", "010",
                           "K\xC3\xBC"
                           "che"}) {
    config.file = text;
    config.things = {{text, {2}}, {"second", {3, 4}}};
    KitchenConfig const back = reloaded(config);
    EXPECT_EQ(back.file, text);
    ASSERT_EQ(back.things.size(), 2U);
    EXPECT_EQ(back.things[0].name, text);
    EXPECT_THAT(back.things[1].size_m, testing::ElementsAre(3, 4));
  }
  for (Pace const pace : {Pace::kOff, Pace::kSlow, Pace::kFast}) {
    config.pace = pace;
    EXPECT_EQ(reloaded(config).pace, pace);
  }
}

TEST(ConfigPrinting, TellsTextRangeAndUnit) {
  KitchenConfig config;
  config.pace = Pace::kOff;
  config.things = {{"table", {1, 2}}};
  EXPECT_EQ(config_yaml(fields(config)), R"(# surface normals
normals:
  window_px: 9  # side of the window ([3, 99] px)
  max_jump_m: 0.02  # largest step on a surface ([0, 0.1] m)
  enabled: true  # whether to look at all
any_number: 0  # a number without a range
gain: 1  # how loud (at least 0)
file: ""  # a file's name
pace: "off"  # how quick (off, slow, fast)
position: [1, 2, 3]  # where it stands (m)
# what stands there
things:
  -
    name: "table"  # what it is called
    size_m: [1, 2]  # edge lengths ([0, 10] m)
)");
}

TEST(ConfigPrinting, MakesAMarkdownTableOfEachSection) {
  KitchenConfig config;
  config.file = "a|b";
  EXPECT_EQ(config_markdown(fields(config)),
            R"(| key | default | unit | allowed | what |
|---|---|---|---|---|
| `any_number` | `0` |  |  | a number without a range |
| `gain` | `1` |  | at least 0 | how loud |
| `file` | `"a\|b"` |  |  | a file's name |
| `pace` | `slow` |  | off, slow, fast | how quick |
| `position` | `[1, 2, 3]` | m |  | where it stands |

## normals

surface normals

| key | default | unit | allowed | what |
|---|---|---|---|---|
| `normals.window_px` | `9` | px | [3, 99] | side of the window |
| `normals.max_jump_m` | `0.02` | m | [0, 0.1] | largest step on a surface |
| `normals.enabled` | `true` |  |  | whether to look at all |
)");
}

TEST(ConfigPrinting, WritesNumbersAsPeopleDo) {
  KitchenConfig config;
  for (auto const& [gain, text] :
       {std::pair(100000.0, "100000"), std::pair(1e-4, "0.0001"), std::pair(2e9, "2e+09"),
        std::pair(-0.25, "-0.25"), std::pair(0.0, "0"), std::pair(1e-7, "1e-07")}) {
    config.gain = gain;
    EXPECT_THAT(config_yaml(fields(config)),
                testing::HasSubstr(std::string("gain: ") + text + "  #"));
  }
}

}  // namespace
}  // namespace credo::test
