#pragma once

#include <cstdint>
#include <vector>

#include "belief.h"
#include "core/belief_summary.hpp"

namespace credo {

// The things of a belief as they travel (idl/credo/belief.idl).

[[nodiscard]] credo_msg_FloorPlane message_of(FloorSummary const& floor);
[[nodiscard]] credo_msg_WallSegment message_of(WallSummary const& wall);
/// Lends the names: DDS takes them by a pointer to char, though it does not write to them.
[[nodiscard]] credo_msg_KnownObject message_of(ObjectSummary& object);
[[nodiscard]] credo_msg_StuffItem message_of(StuffSummary const& stuff);

// The other way. Throws std::runtime_error for evidence that is none.

[[nodiscard]] FloorSummary floor_in(credo_msg_FloorPlane const& message);
[[nodiscard]] WallSummary wall_in(credo_msg_WallSegment const& message);
[[nodiscard]] ObjectSummary object_in(credo_msg_KnownObject const& message);
[[nodiscard]] StuffSummary stuff_in(credo_msg_StuffItem const& message);

/// A sequence that lends the vector's elements.
template <typename Sequence, typename Element>
[[nodiscard]] Sequence lent(std::vector<Element>& elements) {
  Sequence sequence{};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(elements.size());
  sequence._buffer = elements.data();
  sequence._release = false;
  return sequence;
}

}  // namespace credo
