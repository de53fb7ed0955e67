#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stages/segments/kernels.hpp"
#include "stages/segments/row_bits.hpp"

namespace credo::segments {

/// different_bits, but nothing is read beyond `count`.
inline void border_bits(std::int32_t const* a, std::int32_t const* b, std::size_t count,
                        RowBits& out) {
  constexpr std::size_t kWord = 64;
  std::size_t const whole = count - count % kWord;
  different_bits(a, b, whole, out.data());
  if (whole < count) {
    std::uint64_t bits = 0;
    for (std::size_t u = whole; u < count; ++u) {
      bits |= std::uint64_t{a[u] != b[u]} << (u - whole);
    }
    out.data()[whole / kWord] = bits;
  }
}

/// The runs of equal labels in the rows of an image: run_end, for a whole row at once.
class LabelRuns {
public:
  explicit LabelRuns(int width) : width_(static_cast<std::size_t>(width)), borders_(width) {}

  /// The row that `end` is asked of from now on.
  void find(std::span<std::int32_t const> row) {
    if (width_ > 1) {
      border_bits(row.data(), row.data() + 1, width_ - 1, borders_);
    }
  }
  /// Of the run that begins there.
  [[nodiscard]] std::size_t end(std::size_t begin) const {
    auto const last = static_cast<std::size_t>(borders_.next_set(static_cast<int>(begin)));
    return std::min(last + 1, width_);
  }

private:
  std::size_t width_;
  /// 1 where the next pixel differs.
  RowBits borders_;
};

}  // namespace credo::segments
