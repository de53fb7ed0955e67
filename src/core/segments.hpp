#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace credo {

/// A frame in pieces, each a surface that a person would call one thing.
struct Segments {
  /// From 1, in raster order of their first pixels; 0 where there is no depth, or too little of it.
  Grid<std::int32_t> labels;
  /// Pixels of label i + 1.
  std::vector<std::uint32_t> pixel_counts;
};

}  // namespace credo
