#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/bits.hpp"
#include "core/segments.hpp"
#include "geometry/label_bits.hpp"
#include "stages/planes/pixel_set.hpp"

namespace credo {

/// Sets of pixels as pieces of segments: neighbours mostly have one, so that what is counted or
/// moved by segment is many pixels at once.
class SegmentPieces {
public:
  /// `segments` outlives this; empty ones have no pieces.
  explicit SegmentPieces(Segments const& segments)
      : segments_(segments), ends_(std::max<std::size_t>(segments.labels.size(), 1) - 1) {
    if (segments.labels.size() > 1) {
      std::int32_t const* const labels = segments.labels.data();
      mark_different(labels, labels + 1, segments.labels.size() - 1, ends_.words().data());
    }
  }

  [[nodiscard]] bool empty() const { return segments_.labels.empty(); }

  /// Calls `visit(segment, word, bits)` for pixels of one segment within one word, in raster order.
  template <typename Visit>
  void for_each(PixelSet const& pixels, Visit const& visit) const {
    std::span<std::uint64_t const> const ends = ends_.words();
    for (std::size_t w = 0; w < pixels.words().size(); ++w) {
      // The image's last pixel may be a word of its own.
      std::uint64_t const ends_here = w < ends.size() ? ends[w] : 0;
      for (std::uint64_t rest = pixels.words()[w]; rest != 0;) {
        auto const first = static_cast<std::size_t>(std::countr_zero(rest));
        // All pixels up to where this segment ends.
        std::uint64_t const later = ends_here & (~std::uint64_t{0} << first);
        std::uint64_t const mask = later ^ (later - 1);
        visit(static_cast<std::size_t>(segments_.labels[w * PixelSet::kWordBits + first]), w,
              rest & mask);
        rest &= ~mask;
      }
    }
  }

  /// Of each segment, how many of these pixels it has; [0] is of those without a segment. Nothing
  /// without segments.
  [[nodiscard]] std::vector<std::uint32_t> counts(PixelSet const& pixels) const {
    if (empty()) {
      return {};
    }
    std::vector<std::uint32_t> counts(segments_.pixel_counts.size() + 1, 0);
    for_each(pixels, [&](std::size_t segment, std::size_t /*word*/, std::uint64_t bits) {
      counts[segment] += static_cast<std::uint32_t>(count_bits(bits));
    });
    return counts;
  }

  /// Those of the pixels whose segment passes.
  template <typename Test>
  [[nodiscard]] CountedPixels where(PixelSet const& pixels, Test const& test) const {
    CountedPixels result{PixelSet(segments_.labels.size()), 0};
    for_each(pixels, [&](std::size_t segment, std::size_t word, std::uint64_t bits) {
      if (test(segment)) {
        result.insert(word, bits);
      }
    });
    return result;
  }

private:
  Segments const& segments_;
  /// Pixels after which, in raster order, comes another segment's.
  PixelSet ends_;
};

}  // namespace credo
