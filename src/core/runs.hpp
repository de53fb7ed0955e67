#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bits.hpp"

namespace credo {

/// The end of the run of equal values that begins at `begin`.
template <typename T>
[[nodiscard]] std::size_t run_end(std::span<T const> values, std::size_t begin) {
  constexpr std::size_t kStep = 32;
  T const value = values[begin];
  std::size_t end = begin + 1;
  // Several at once without a branch, and no fewer: then it vectorises instead of being unrolled.
  for (; end + kStep <= values.size(); end += kStep) {
    int others = 0;
    for (std::size_t i = 0; i < kStep; ++i) {
      others |= values[end + i] != value ? 1 : 0;
    }
    if (others != 0) {
      break;
    }
  }
  while (end < values.size() && values[end] == value) {
    ++end;
  }
  return end;
}

/// Calls `visit(begin, end)` for each run in which two rows of one length both keep their values.
template <typename A, typename B, typename Visit>
void for_each_run(std::span<A const> a, std::span<B const> b, Visit const& visit) {
  if (a.empty()) {
    return;
  }
  std::size_t const last = a.size() - 1;
  std::size_t begin = 0;
  for (std::size_t word = 0; word < last; word += kWordBits) {
    A const* const at_a = a.data() + word;
    B const* const at_b = b.data() + word;
    std::uint64_t ends = bits_where(std::min(kWordBits, last - word), [&](std::size_t i) {
      return ((at_a[i] != at_a[i + 1] ? 1 : 0) | (at_b[i] != at_b[i + 1] ? 1 : 0)) != 0;
    });
    for (; ends != 0; ends &= ends - 1) {
      std::size_t const end = word + static_cast<std::size_t>(std::countr_zero(ends)) + 1;
      visit(begin, end);
      begin = end;
    }
  }
  visit(begin, a.size());
}

}  // namespace credo
