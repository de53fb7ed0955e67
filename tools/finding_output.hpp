#pragma once

#include <string>
#include <vector>

#include "doctor/finding.hpp"

namespace credo {

/// Whether none of them is an error.
bool is_well(std::vector<Finding> const& findings);

/// A line a finding under its section's name, and one for what to do; the words ok, warning and
/// error in colour where wanted.
std::string findings_text(std::vector<Finding> const& findings, bool in_color);

/// {"findings":[{"section","name","level","found","advice"}], "ok"}
std::string findings_json(std::vector<Finding> const& findings);

}  // namespace credo
