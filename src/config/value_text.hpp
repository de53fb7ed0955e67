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

/// "off, auto".
std::string words_text(ChoiceTarget const& choice);

/// Sets a scalar field from its text. Returns what is wrong with it, or an empty string; the field
/// then keeps its value. Numbers must be finite and in range, without leading zeros (some YAML
/// readers take 010 for 8); booleans are true and false only (others take yes and on for true).
std::string set_from_text(Field const& field, std::string const& text);

/// What is wrong with a number for this field, or an empty string.
std::string check_range(Field const& field, double value);

}  // namespace credo
