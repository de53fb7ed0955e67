#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

namespace credo::segments {

/// A row-major image within a margin of zeros, so that windows and whole vectors may reach beyond
/// it without a check. Values within the image are not set.
template <typename T>
class PaddedGrid {
public:
  /// Columns between a row and the next, for both: as far as a window reaches, and what a vector
  /// writes beyond the last pixel.
  static constexpr int kMargin = 96;
  /// Rows above and below: as far as the widest window reaches, and as far as others do.
  static constexpr int kMarginRows = 64;
  static constexpr int kFewMarginRows = 8;
  static constexpr int kLanes = 64;

  PaddedGrid(int width, int height, int margin_rows = kMarginRows)
      : width_(width),
        height_(height),
        margin_rows_(margin_rows),
        stride_(width + kMargin),
        data_(new T[static_cast<std::size_t>(stride_) *
                        static_cast<std::size_t>(height + 2 * margin_rows) +
                    2 * kMargin]) {
    // Before the first row, between each and the next, behind the last.
    std::fill(row(-margin_rows) - kMargin, row(0), T{});
    for (int v = 0; v < height; ++v) {
      std::fill(row(v) + width_, row(v + 1), T{});
    }
    std::fill(row(height), row(height + margin_rows) + kMargin, T{});
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// From one row to the next.
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  /// Column 0 of a row, from as far above the image as the margin has rows.
  [[nodiscard]] T* row(int v) { return data_.get() + origin(v); }
  [[nodiscard]] T const* row(int v) const { return data_.get() + origin(v); }
  /// Clears what vectors of up to kLanes wrote beyond the row's last pixel.
  void end_row(int v) {
    std::fill(row(v) + width_, row(v) + (width_ + kLanes - 1) / kLanes * kLanes, T{});
  }

private:
  [[nodiscard]] std::ptrdiff_t origin(int v) const {
    return (v + margin_rows_) * stride_ + kMargin;
  }

  int width_;
  int height_;
  int margin_rows_;
  std::ptrdiff_t stride_;
  // Not a vector: that would write every value twice.
  std::unique_ptr<T[]> data_;
};

}  // namespace credo::segments
