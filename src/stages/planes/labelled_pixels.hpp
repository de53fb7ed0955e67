#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/label.hpp"
#include "core/segments.hpp"
#include "stages/planes/pixel_set.hpp"
#include "stages/planes/segment_pieces.hpp"

namespace credo {

/// The pixels that floor and walls may have: without what lies on a surface, which is near to that
/// surface's plane, but nothing of it.
inline CountedPixels unassigned_pixels(LabelMap const& labels, Segments const& segments,
                                       SegmentPieces const& pieces) {
  CountedPixels pixels = pixels_where(
      labels.size(), [codes = labels.data()](std::size_t i) { return codes[i] == kUnassigned; });
  if (std::ranges::any_of(segments.lies_on, [](std::int32_t base) { return base != 0; })) {
    pixels.remove(pieces.where(pixels.pixels, [&](std::size_t segment) {
      return segment != 0 && segments.lies_on[segment - 1] != 0;
    }));
  }
  return pixels;
}

inline CountedPixels pixels_with_depth(LabelMap const& labels) {
  return pixels_where(labels.size(),
                      [codes = labels.data()](std::size_t i) { return codes[i] != kNoDepth; });
}

}  // namespace credo
