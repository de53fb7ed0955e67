#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/bits.hpp"
#include "core/label.hpp"
#include "core/segments.hpp"
#include "geometry/label_bits.hpp"
#include "stages/planes/pixel_set.hpp"
#include "stages/planes/segment_pieces.hpp"

namespace credo {

inline CountedPixels pixels_labelled(LabelMap const& labels, LabelCode label) {
  CountedPixels result{PixelSet(labels.size()), 0};
  mark_equal(labels.data(), label, labels.size(), result.pixels.words().data());
  for (std::uint64_t const word : result.pixels.words()) {
    result.count += count_bits(word);
  }
  return result;
}

/// The pixels that floor and walls may have: without what lies on a surface, which is near to that
/// surface's plane, but nothing of it.
inline CountedPixels unassigned_pixels(LabelMap const& labels, Segments const& segments,
                                       SegmentPieces const& pieces) {
  CountedPixels pixels = pixels_labelled(labels, kUnassigned);
  if (std::ranges::any_of(segments.lies_on, [](std::int32_t base) { return base != 0; })) {
    pixels.remove(pieces.where(pixels.pixels, [&](std::size_t segment) {
      return segment != 0 && segments.lies_on[segment - 1] != 0;
    }));
  }
  return pixels;
}

inline CountedPixels pixels_with_depth(LabelMap const& labels) {
  CountedPixels result = all_pixels(labels.size());
  result.remove(pixels_labelled(labels, kNoDepth));
  return result;
}

}  // namespace credo
