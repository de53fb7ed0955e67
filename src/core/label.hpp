#pragma once

#include <cstddef>
#include <cstdint>

#include "core/grid.hpp"

namespace credo {

/// A pixel's label in the label image of one frame. The codes are a file format.
using LabelCode = std::uint16_t;
using LabelMap = Grid<LabelCode>;

inline constexpr LabelCode kNoDepth = 0;
inline constexpr LabelCode kUnassigned = 1;
inline constexpr LabelCode kFloor = 1000;
inline constexpr LabelCode kFirstWall = 2000;
inline constexpr LabelCode kFirstObject = 3000;
inline constexpr LabelCode kFirstStuff = 4000;

inline constexpr std::size_t kMaxWalls = kFirstObject - kFirstWall;
inline constexpr std::size_t kMaxObjects = kFirstStuff - kFirstObject;
inline constexpr std::size_t kMaxStuff = 65536 - kFirstStuff;

[[nodiscard]] constexpr bool is_wall(LabelCode c) {
  return c >= kFirstWall && c < kFirstObject;
}
[[nodiscard]] constexpr bool is_object(LabelCode c) {
  return c >= kFirstObject && c < kFirstStuff;
}
[[nodiscard]] constexpr bool is_stuff(LabelCode c) {
  return c >= kFirstStuff;
}

}  // namespace credo
