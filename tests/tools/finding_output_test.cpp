#include "tools/finding_output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace credo::test {
namespace {

using nlohmann::json;

std::vector<Finding> some() {
  return {{"USB", "bus", FindingLevel::kOk, "fine", ""},
          {"USB", "speed", FindingLevel::kWarning, "slow", "plug it in"},
          {"floor", "floor", FindingLevel::kError, "none", "turn it"}};
}

TEST(FindingOutput, ALineEachUnderItsSection) {
  EXPECT_EQ(findings_text(some(), false),
            "USB\n"
            "  ok       bus: fine\n"
            "  warning  speed: slow\n"
            "           -> plug it in\n"
            "floor\n"
            "  error    floor: none\n"
            "           -> turn it\n");
}

TEST(FindingOutput, ColourIsOfTheWordsAlone) {
  EXPECT_EQ(findings_text({some()[0]}, true), "USB\n  \033[32mok\033[0m       bus: fine\n");
}

TEST(FindingOutput, Json) {
  json const all = json::parse(findings_json(some()));
  EXPECT_EQ(all["ok"], false);
  ASSERT_EQ(all["findings"].size(), 3U);
  EXPECT_EQ(all["findings"][1], json({{"section", "USB"},
                                      {"name", "speed"},
                                      {"level", "warning"},
                                      {"found", "slow"},
                                      {"advice", "plug it in"}}));
}

TEST(FindingOutput, WarningsAreNoErrors) {
  std::vector<Finding> findings = some();
  findings.pop_back();
  EXPECT_TRUE(is_well(findings));
  EXPECT_EQ(json::parse(findings_json(findings))["ok"], true);
  EXPECT_FALSE(is_well(some()));
  EXPECT_EQ(json::parse(findings_json({}))["findings"], json::array());
}

TEST(FindingOutput, TextsOfAnyEncoding) {
  json const all =
      json::parse(findings_json({{"sensors", "a", FindingLevel::kOk, "name \xFF", ""}}));
  EXPECT_EQ(all["findings"][0]["found"], "name \uFFFD");
}

}  // namespace
}  // namespace credo::test
