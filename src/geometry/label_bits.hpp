#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bits.hpp"
#include "core/label.hpp"

namespace credo {

// Comparisons of `count` labels, in words of 64: bit i % 64 of word i / 64 is of the i-th, and bits
// beyond the last are 0. Nothing beyond the last is read. The same on every instruction set.

/// 1 where labels differ.
void mark_different(std::int32_t const* a, std::int32_t const* b, std::size_t count,
                    std::uint64_t* bits);
void mark_different(LabelCode const* a, LabelCode const* b, std::size_t count, std::uint64_t* bits);
/// 1 where it is that label.
void mark_equal(LabelCode const* labels, LabelCode label, std::size_t count, std::uint64_t* bits);

/// Calls `visit(begin, end)` for each run in which two rows of one length both keep their labels.
template <typename Visit>
void for_each_run(std::span<LabelCode const> codes, std::span<std::int32_t const> segments,
                  Visit const& visit) {
  if (codes.empty()) {
    return;
  }
  constexpr std::size_t kWords = 16;
  std::array<std::uint64_t, kWords> code_ends{};
  std::array<std::uint64_t, kWords> segment_ends{};
  std::size_t const last = codes.size() - 1;
  std::size_t begin = 0;
  for (std::size_t at = 0; at < last; at += kWords * kWordBits) {
    std::size_t const count = std::min(kWords * kWordBits, last - at);
    LabelCode const* const code = codes.data() + at;
    std::int32_t const* const segment = segments.data() + at;
    mark_different(code, code + 1, count, code_ends.data());
    mark_different(segment, segment + 1, count, segment_ends.data());
    for (std::size_t w = 0; w * kWordBits < count; ++w) {
      for (std::uint64_t ends = code_ends[w] | segment_ends[w]; ends != 0; ends &= ends - 1) {
        std::size_t const end =
            at + w * kWordBits + static_cast<std::size_t>(std::countr_zero(ends)) + 1;
        visit(begin, end);
        begin = end;
      }
    }
  }
  visit(begin, codes.size());
}

}  // namespace credo
