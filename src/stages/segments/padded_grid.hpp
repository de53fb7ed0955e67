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
  /// Columns to each side: as far as a window reaches, and what a vector reads or writes beyond the
  /// last pixel.
  static constexpr int kMargin = 96;
  /// Rows above and below: as far as a window reaches.
  static constexpr int kMarginRows = 64;

  PaddedGrid(int width, int height)
      : width_(width),
        height_(height),
        stride_(width + 2 * kMargin),
        data_(new T[static_cast<std::size_t>(stride_) *
                    static_cast<std::size_t>(height + 2 * kMarginRows)]) {
    std::fill(row(-kMarginRows) - kMargin, row(0) - kMargin, T{});
    for (int v = 0; v < height; ++v) {
      std::fill(row(v) - kMargin, row(v), T{});
      end_row(v);
    }
    std::fill(row(height) - kMargin, row(height + kMarginRows) - kMargin, T{});
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// From one row to the next.
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  /// Column 0 of a row, from -kMarginRows on.
  [[nodiscard]] T* row(int v) { return data_.get() + origin(v); }
  [[nodiscard]] T const* row(int v) const { return data_.get() + origin(v); }
  /// Clears what a vector wrote beyond the row's last pixel.
  void end_row(int v) { std::fill(row(v) + width_, row(v) + width_ + kMargin, T{}); }

private:
  [[nodiscard]] std::ptrdiff_t origin(int v) const { return (v + kMarginRows) * stride_ + kMargin; }

  int width_;
  int height_;
  std::ptrdiff_t stride_;
  // Not a vector: that would write every value twice.
  std::unique_ptr<T[]> data_;
};

}  // namespace credo::segments
