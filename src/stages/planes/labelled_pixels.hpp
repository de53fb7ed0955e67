#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/label.hpp"
#include "stages/planes/pixel_set.hpp"

namespace credo {

/// The pixels whose label passes.
template <typename Test>
CountedPixels pixels_where(LabelMap const& labels, Test const& test) {
  CountedPixels result{PixelSet(labels.size()), 0};
  std::span<std::uint64_t> const words = result.pixels.words();
  for (std::size_t w = 0; w < words.size(); ++w) {
    std::size_t const begin = w * PixelSet::kWordBits;
    std::size_t const end = std::min(begin + PixelSet::kWordBits, labels.size());
    std::uint64_t bits = 0;
    for (std::size_t i = begin; i < end; ++i) {
      bits |= std::uint64_t{test(labels[i])} << (i - begin);
    }
    words[w] = bits;
    result.count += static_cast<std::size_t>(std::popcount(bits));
  }
  return result;
}

inline CountedPixels unassigned_pixels(LabelMap const& labels) {
  return pixels_where(labels, [](LabelCode label) { return label == kUnassigned; });
}

inline CountedPixels pixels_with_depth(LabelMap const& labels) {
  return pixels_where(labels, [](LabelCode label) { return label != kNoDepth; });
}

}  // namespace credo
