#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace credo {

/// A frame in pieces, each a surface that a person would call one thing.
struct Segments {
  /// From 1, in raster order of their first pixels, those that lie on others after the rest; 0
  /// where there is no depth, or too little of it.
  Grid<std::int32_t> labels;
  /// Pixels of label i + 1.
  std::vector<std::uint32_t> pixel_counts;
  /// Of label i + 1: the segment that it lies on so closely that floor, walls and objects would
  /// take it for a part of that; 0 for most.
  std::vector<std::int32_t> lies_on;
};

}  // namespace credo
