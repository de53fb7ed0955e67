#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "belief.h"
#include "core/belief_summary.hpp"

namespace credo {

// The things of a belief as they travel (idl/credo/belief.idl).

[[nodiscard]] credo_msg_FloorPlane message_of(FloorSummary const& floor);
[[nodiscard]] credo_msg_WallSegment message_of(WallSummary const& wall);
/// Lends the names: DDS takes them by a pointer to char, though it does not write to them.
[[nodiscard]] credo_msg_KnownObject message_of(ObjectSummary& object);
/// Lends the joined ids.
[[nodiscard]] credo_msg_StuffItem message_of(StuffSummary const& stuff);

// The other way. Throws std::runtime_error for evidence that is none.

[[nodiscard]] FloorSummary floor_in(credo_msg_FloorPlane const& message);
[[nodiscard]] WallSummary wall_in(credo_msg_WallSegment const& message);
[[nodiscard]] ObjectSummary object_in(credo_msg_KnownObject const& message);
[[nodiscard]] StuffSummary stuff_in(credo_msg_StuffItem const& message);

/// Lends the text: DDS takes it by a pointer to char, though it does not write to it.
[[nodiscard]] inline char* lent_text(std::string const& text) {
  return const_cast<char*>(text.c_str());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

/// A sequence that lends what lies there: DDS does not write to it, either.
template <typename Sequence, typename Value>
[[nodiscard]] Sequence lent_values(Value const* first, std::size_t count) {
  Sequence sequence{};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(count);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  sequence._buffer = const_cast<Value*>(first);
  return sequence;
}

/// A sequence that lends the vector's elements.
template <typename Sequence, typename Element>
[[nodiscard]] Sequence lent(std::vector<Element>& elements) {
  return lent_values<Sequence>(elements.data(), elements.size());
}

}  // namespace credo
