#pragma once

#include <gmock/gmock.h>

#include <ostream>
#include <string>
#include <vector>

#include "doctor/finding.hpp"

namespace credo::test {

/// A finding of that level, whose name has `name` in it.
inline auto finding(FindingLevel level, std::string const& name, std::string const& found,
                    std::string const& advice = "") {
  using ::testing::AllOf;
  using ::testing::Field;
  using ::testing::HasSubstr;
  return AllOf(Field("level", &Finding::level, level),
               Field("name", &Finding::name, HasSubstr(name)),
               Field("found", &Finding::found, HasSubstr(found)),
               Field("advice", &Finding::advice, HasSubstr(advice)));
}

inline auto ok(std::string const& name, std::string const& found = "") {
  return finding(FindingLevel::kOk, name, found);
}
inline auto warning(std::string const& name, std::string const& found,
                    std::string const& advice = "") {
  return finding(FindingLevel::kWarning, name, found, advice);
}
inline auto error(std::string const& name, std::string const& found,
                  std::string const& advice = "") {
  return finding(FindingLevel::kError, name, found, advice);
}

/// Those that are not ok.
inline std::vector<Finding> troubles(std::vector<Finding> findings) {
  std::erase_if(findings, [](Finding const& one) { return one.level == FindingLevel::kOk; });
  return findings;
}

}  // namespace credo::test

namespace credo {

inline void PrintTo(Finding const& one, std::ostream* out) {
  *out << static_cast<int>(one.level) << " " << one.name << ": " << one.found << " -> "
       << one.advice;
}

}  // namespace credo
