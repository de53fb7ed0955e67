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

}  // namespace credo
