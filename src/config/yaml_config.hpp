#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/fields.hpp"

namespace credo {

/// Applies YAML files and then `key.path=value` overrides onto the described structs, later ones
/// over earlier ones. Everything is checked, and all errors are reported at once: throws InputError
/// with one line for each (file:line:column: key = value: what is wrong). The structs are then
/// partly changed and must not be used.
void load_config(FieldList const& fields, std::vector<std::filesystem::path> const& files,
                 std::vector<std::string> const& overrides);

/// The current values as YAML, each with its text, unit and range as a comment. What is not
/// given (empty or 0 where that may not be written) is left out. Loading it gives the same values,
/// to the bit.
std::string config_yaml(FieldList const& fields);

/// The same as Markdown: a heading and a table (key, value, unit, allowed values, text) for each
/// section; what is in no section comes first. Lists of structs are left out.
std::string config_markdown(FieldList const& fields);

}  // namespace credo
