#include "finding_output.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace credo {
namespace {

char const* name_of(FindingLevel level) {
  switch (level) {
    case FindingLevel::kOk:
      return "ok";
    case FindingLevel::kWarning:
      return "warning";
    case FindingLevel::kError:
      return "error";
  }
  return "";
}

char const* color_of(FindingLevel level) {
  switch (level) {
    case FindingLevel::kOk:
      return "\033[32m";
    case FindingLevel::kWarning:
      return "\033[33m";
    case FindingLevel::kError:
      return "\033[1;31m";
  }
  return "";
}

/// All words as wide as the longest, "warning".
std::string word(FindingLevel level, bool in_color) {
  std::string const name = name_of(level);
  std::string const blanks(std::string("warning").size() - name.size(), ' ');
  return in_color ? color_of(level) + name + "\033[0m" + blanks : name + blanks;
}

}  // namespace

bool is_well(std::vector<Finding> const& findings) {
  return std::ranges::none_of(findings,
                              [](Finding const& one) { return one.level == FindingLevel::kError; });
}

std::string findings_text(std::vector<Finding> const& findings, bool in_color) {
  std::string text;
  std::string section;
  for (Finding const& finding : findings) {
    if (finding.section != section) {
      section = finding.section;
      text += section + "\n";
    }
    text +=
        "  " + word(finding.level, in_color) + "  " + finding.name + ": " + finding.found + "\n";
    if (!finding.advice.empty()) {
      text += "           -> " + finding.advice + "\n";
    }
  }
  return text;
}

std::string findings_json(std::vector<Finding> const& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (Finding const& finding : findings) {
    list.push_back({{"section", finding.section},
                    {"name", finding.name},
                    {"level", name_of(finding.level)},
                    {"found", finding.found},
                    {"advice", finding.advice}});
  }
  nlohmann::ordered_json const all = {{"findings", std::move(list)}, {"ok", is_well(findings)}};
  // Texts of devices and libraries may be of any encoding.
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace credo
