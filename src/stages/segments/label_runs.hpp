#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/label_bits.hpp"
#include "stages/segments/row_bits.hpp"

namespace credo::segments {

/// The runs of equal labels in the rows of an image: run_end, for a whole row at once.
class LabelRuns {
public:
  explicit LabelRuns(int width) : width_(static_cast<std::size_t>(width)), borders_(width) {}

  /// The row that `end` is asked of from now on.
  void find(std::span<std::int32_t const> row) {
    if (width_ > 1) {
      mark_different(row.data(), row.data() + 1, width_ - 1, borders_.data());
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
