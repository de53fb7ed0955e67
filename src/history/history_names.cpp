#include "history/history_names.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

namespace credo {
namespace {

constexpr char const* kWallPrefix = "wall:";
constexpr char const* kStuffPrefix = "stuff:";
constexpr char const* kObjectPrefix = "object:";

bool is_number(std::string const& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// As histories are called.
std::string full_name(std::string const& name) {
  return is_number(name) ? kStuffPrefix + name : name;
}

/// Letters to change, add or take away.
std::size_t changes(std::string const& a, std::string const& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      std::size_t const replaced = diagonal + (a[i] == b[j] ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// Numbers of one kind are as far as they differ, whatever else is farther than these.
double distance(std::string const& a, std::string const& b) {
  constexpr double kFartherThanNumbers = 1e12;
  for (std::string const prefix : {kWallPrefix, kStuffPrefix}) {
    if (a.starts_with(prefix) && b.starts_with(prefix) && is_number(a.substr(prefix.size())) &&
        is_number(b.substr(prefix.size()))) {
      return std::abs(std::strtod(a.c_str() + prefix.size(), nullptr) -
                      std::strtod(b.c_str() + prefix.size(), nullptr));
    }
  }
  return kFartherThanNumbers + static_cast<double>(changes(a, b));
}

}  // namespace

std::string thing_name(ThingKind kind, std::string const& id) {
  switch (kind) {
    case ThingKind::kFloorPlane:
      return "floor";
    case ThingKind::kWallPlane:
      return kWallPrefix + id;
    case ThingKind::kStuff:
      return kStuffPrefix + id;
    case ThingKind::kObject:
      break;
  }
  bool const is_plain = id != "floor" && !is_number(id) && !id.starts_with(kWallPrefix) &&
                        !id.starts_with(kStuffPrefix) && !id.starts_with(kObjectPrefix);
  return is_plain ? id : kObjectPrefix + id;
}

ThingHistory const* find_thing(std::vector<ThingHistory> const& histories,
                               std::string const& name) {
  std::string const prefix = kObjectPrefix;
  bool const is_object = name.starts_with(prefix);
  std::string const id = is_object ? name.substr(prefix.size()) : name;
  for (std::string const& wanted : {full_name(name), thing_name(ThingKind::kObject, id)}) {
    auto const found = std::ranges::find(histories, wanted, &ThingHistory::name);
    if (found != histories.end() && (!is_object || found->kind == ThingKind::kObject)) {
      return &*found;
    }
  }
  return nullptr;
}

std::vector<std::string> near_names(std::vector<ThingHistory> const& histories,
                                    std::string const& name, std::size_t count) {
  std::string const wanted = full_name(name);
  std::vector<std::string> names;
  names.reserve(histories.size());
  for (ThingHistory const& history : histories) {
    names.push_back(history.name);
  }
  std::ranges::stable_sort(names, {}, [&](std::string const& n) { return distance(wanted, n); });
  names.resize(std::min(names.size(), count));
  return names;
}

}  // namespace credo
