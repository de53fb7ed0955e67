#include "config/value_text.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

namespace credo {
namespace {

template <typename T>
std::string shortest(T value) {
  std::array<char, 64> text{};
  char* const begin = text.data();
  char* end = begin + text.size();
  T const size = std::abs(value);
  // 100000 rather than 1e+05: people read these.
  bool const plain = size >= T(1e-5) && size < T(1e9);
  end = plain ? std::to_chars(begin, end, value, std::chars_format::fixed).ptr
              : std::to_chars(begin, end, value).ptr;
  return {begin, end};
}

std::string quoted(std::string const& text) {
  constexpr char const* kHex = "0123456789abcdef";
  std::string result = "\"";
  for (char const c : text) {
    auto const code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {
      // YAML folds line breaks inside quotes; escaped, they stay.
      result += {'\\', 'x', kHex[code >> 4U], kHex[code & 15U]};
      continue;
    }
    if (c == '"' || c == '\\') {
      result += '\\';
    }
    result += c;
  }
  return result + '"';
}

template <typename T>
std::optional<T> parse(std::string const& text) {
  T value{};
  char const* begin = text.data();
  char const* end = begin + text.size();
  // from_chars knows no plus sign; "+-5" is no number for all that.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    ++begin;
  }
  auto const result = std::from_chars(begin, end, value);
  if (result.ec != std::errc() || result.ptr != end) {
    return std::nullopt;
  }
  return value;
}

bool has_leading_zero(std::string const& text) {
  std::size_t const first = text.find_first_of("0123456789");
  return first != std::string::npos && text[first] == '0' && first + 1 < text.size() &&
         std::isdigit(static_cast<unsigned char>(text[first + 1])) != 0;
}

std::string set_number(Field const& field, int* target, std::string const& text) {
  if (has_leading_zero(text)) {
    return "must be a whole number without leading zeros";
  }
  std::optional<std::int64_t> const value = parse<std::int64_t>(text);
  if (!value) {
    return "must be a whole number";
  }
  std::string error = check_range(field, static_cast<double>(*value));
  if (error.empty() && !std::in_range<int>(*value)) {
    error = "must be a whole number of at most 32 bits";
  }
  if (error.empty()) {
    *target = static_cast<int>(*value);
  }
  return error;
}

template <typename T>
std::string set_number(Field const& field, T* target, std::string const& text) {
  if (has_leading_zero(text)) {
    return "must be a number without leading zeros";
  }
  // The range is checked before rounding: 0.1F lies above 0.1.
  std::optional<double> const written = parse<double>(text);
  std::optional<T> const value = parse<T>(text);
  if (!written || !value) {
    return "must be a number";
  }
  std::string error = check_range(field, *written);
  if (error.empty()) {
    *target = *value;
  }
  return error;
}

std::string set_bool(bool* target, std::string const& text) {
  if (text != "true" && text != "false") {
    return "must be true or false";
  }
  *target = text == "true";
  return {};
}

std::string set_choice(ChoiceTarget const& target, std::string const& text) {
  for (std::size_t i = 0; i < target.words.size(); ++i) {
    if (target.words[i] == text) {
      target.set(i);
      return {};
    }
  }
  return "must be one of " + words_text(target);
}

}  // namespace

std::string number_text(double value) {
  return shortest(value);
}
std::string number_text(float value) {
  return shortest(value);
}

std::string words_text(ChoiceTarget const& choice) {
  std::string text;
  for (std::string const& word : choice.words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::string range_text(Range const& range) {
  bool const low = std::isfinite(range.min);
  bool const high = std::isfinite(range.max);
  if (low && high) {
    return "[" + number_text(range.min) + ", " + number_text(range.max) + "]";
  }
  return low    ? "at least " + number_text(range.min)
         : high ? "at most " + number_text(range.max)
                : std::string();
}

std::string check_range(Field const& field, double value) {
  if (std::isfinite(value) && value >= field.range.min && value <= field.range.max) {
    return {};
  }
  std::string const unit = field.unit.empty() ? "" : " " + field.unit;
  std::string const range = range_text(field.range);
  return range.empty() ? "must be a finite number"
                       : "must be " + std::string(range.front() == '[' ? "in " : "") + range + unit;
}

std::string value_text(Field const& field) {
  return std::visit(
      [](auto const& target) -> std::string {
        using T = std::decay_t<decltype(target)>;
        if constexpr (std::is_same_v<T, bool*>) {
          return *target ? "true" : "false";
        } else if constexpr (std::is_same_v<T, int*>) {
          return std::to_string(*target);
        } else if constexpr (std::is_same_v<T, float*> || std::is_same_v<T, double*>) {
          return number_text(*target);
        } else if constexpr (std::is_same_v<T, std::string*>) {
          return quoted(*target);
        } else if constexpr (std::is_same_v<T, ChoiceTarget>) {
          // Quoted, because YAML takes the word off for a boolean.
          std::string const word = target.words.at(target.get());
          return word == "off" || word == "on" ? quoted(word) : word;
        } else if constexpr (std::is_same_v<T, NumbersTarget>) {
          std::string text;
          for (double const value : *target.values) {
            text += (text.empty() ? "" : ", ") + number_text(value);
          }
          return "[" + text + "]";
        } else {
          return {};
        }
      },
      field.target);
}

std::string set_from_text(Field const& field, std::string const& text) {
  return std::visit(
      [&](auto const& target) -> std::string {
        using T = std::decay_t<decltype(target)>;
        if constexpr (std::is_same_v<T, bool*>) {
          return set_bool(target, text);
        } else if constexpr (std::is_same_v<T, int*> || std::is_same_v<T, float*> ||
                             std::is_same_v<T, double*>) {
          return set_number(field, target, text);
        } else if constexpr (std::is_same_v<T, std::string*>) {
          *target = text;
          return {};
        } else if constexpr (std::is_same_v<T, ChoiceTarget>) {
          return set_choice(target, text);
        } else if constexpr (std::is_same_v<T, NumbersTarget>) {
          return "must be a list of numbers";
        } else {
          return "is a section, not a value";
        }
      },
      field.target);
}

}  // namespace credo
