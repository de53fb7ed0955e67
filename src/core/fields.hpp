#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace credo {

/// Closed interval of allowed numbers.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

struct Field;
/// Describes a struct once, for loading, checks, printing and documentation. Each config struct has
/// a free function `FieldList fields(Config&)` beside it; the list points into that struct.
using FieldList = std::vector<Field>;

/// A value out of a fixed set of words.
struct ChoiceTarget {
  std::vector<std::string> words;
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};

/// A list of structs; `append` adds a default one and describes it. Load it before the next append:
/// growing the list moves the structs.
struct ListTarget {
  std::function<FieldList()> append;
  std::function<std::vector<FieldList>()> items;
  std::function<void()> clear;
};

/// Numbers whose count must lie in [min_count, max_count]; the range holds for each.
struct NumbersTarget {
  std::vector<double>* values = nullptr;
  std::size_t min_count = 0;
  std::size_t max_count = std::numeric_limits<std::size_t>::max();
  /// A single number may stand for max_count equal ones.
  bool one_for_all = false;
};

/// How a value that may be written in several ways is written.
enum class Form : std::uint8_t { kWord, kMap, kList };

struct OneOfTarget;

/// One member: its key in YAML, where it lives, its unit ("" for none), allowed range (numbers) and
/// one line of text.
struct Field {
  using Target = std::variant<bool*, int*, float*, double*, std::string*, NumbersTarget,
                              ChoiceTarget, FieldList, ListTarget, std::shared_ptr<OneOfTarget>>;
  std::string name;
  Target target;
  Range range;
  std::string unit;
  std::string text;
};

/// A value that is a word, a map or a list, as it is written; `form` tells which.
struct OneOfTarget {
  Form* form = nullptr;
  ChoiceTarget word;
  FieldList map;
  ListTarget list;
};

/// A member that is itself a described struct.
inline Field section(std::string name, FieldList members, std::string text) {
  return {std::move(name), Field::Target(std::move(members)), {}, "", std::move(text)};
}

/// An enum whose values count from 0 in the order of `words`.
template <typename Enum>
ChoiceTarget choice_target(Enum& value, std::vector<std::string> words) {
  return {
      std::move(words),
      [&value] { return static_cast<std::size_t>(value); },
      [&value](std::size_t i) { value = static_cast<Enum>(i); },
  };
}
template <typename Enum>
Field choice(std::string name, Enum& value, std::vector<std::string> words, std::string text) {
  return {std::move(name),
          Field::Target(choice_target(value, std::move(words))),
          {},
          "",
          std::move(text)};
}

/// A list of structs, each described by `fields(T&)`.
template <typename T>
ListTarget list_target(std::vector<T>& values) {
  return {
      [&values] { return fields(values.emplace_back()); },
      [&values] {
        std::vector<FieldList> lists;
        lists.reserve(values.size());
        for (T& value : values) {
          lists.push_back(fields(value));
        }
        return lists;
      },
      [&values] { values.clear(); },
  };
}
template <typename T>
Field list_of(std::string name, std::vector<T>& values, std::string text) {
  return {std::move(name), Field::Target(list_target(values)), {}, "", std::move(text)};
}

}  // namespace credo
