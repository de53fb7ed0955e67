#pragma once

#include <string>

#include "core/fields.hpp"

namespace credo {

/// The shortest text that reads back as the same number.
std::string number_text(double value);
std::string number_text(float value);

/// The value of a field as YAML writes it; empty for sections and lists.
std::string value_text(Field const& field);

/// "[0, 1]", "at least 0", "at most 1", or empty.
std::string range_text(Range const& range);

/// Sets a scalar field from its text. Returns what is wrong with it, or an empty string. Numbers
/// must be finite and in range; whole numbers have no leading zeros (YAML would read octal); words
/// are not numbers and numbers are not booleans.
std::string set_from_text(Field const& field, std::string const& text);

/// What is wrong with a number for this field, or an empty string.
std::string check_range(Field const& field, double value);

}  // namespace credo
