#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "history/history.hpp"

namespace credo {

/// The name of a history: `id` is a wall's or stuff's number, or an object's id.
[[nodiscard]] std::string thing_name(ThingKind kind, std::string const& id);

/// What people mean by a name: a history's name, a bare number for stuff, or an object's name with
/// or without "object:". Null where there is no such thing.
[[nodiscard]] ThingHistory const* find_thing(std::vector<ThingHistory> const& histories,
                                             std::string const& name);

/// At most `count` names of histories, nearest first: of numbers those that differ least, of words
/// those that take the fewest changes of a letter.
[[nodiscard]] std::vector<std::string> near_names(std::vector<ThingHistory> const& histories,
                                                  std::string const& name, std::size_t count);

}  // namespace credo
