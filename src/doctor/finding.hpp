#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace credo {

enum class FindingLevel : std::uint8_t { kOk, kWarning, kError };

/// One thing that was looked at.
struct Finding {
  std::string section;
  std::string name;
  FindingLevel level = FindingLevel::kOk;
  std::string found;
  /// What to do; empty where all is well.
  std::string advice;
};

/// Findings of one section, as they are made.
class Section {
public:
  explicit Section(std::string title) : title_(std::move(title)) {}

  void ok(std::string name, std::string found) {
    add({title_, std::move(name), FindingLevel::kOk, std::move(found), ""});
  }
  void warning(std::string name, std::string found, std::string advice) {
    add({title_, std::move(name), FindingLevel::kWarning, std::move(found), std::move(advice)});
  }
  void error(std::string name, std::string found, std::string advice) {
    add({title_, std::move(name), FindingLevel::kError, std::move(found), std::move(advice)});
  }
  [[nodiscard]] std::vector<Finding> take() { return std::move(findings_); }

private:
  void add(Finding finding) { findings_.push_back(std::move(finding)); }

  std::string title_;
  std::vector<Finding> findings_;
};

}  // namespace credo
