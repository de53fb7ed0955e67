#pragma once

#include <cstddef>
#include <span>

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
  std::size_t end_of_a = 0;
  for (std::size_t begin = 0; begin < a.size(); begin = end_of_a) {
    end_of_a = run_end(a, begin);
    std::size_t end = 0;
    for (std::size_t i = begin; i < end_of_a; i = end) {
      end = run_end(b.first(end_of_a), i);
      visit(i, end);
    }
  }
}

}  // namespace credo
