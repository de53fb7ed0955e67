#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace credo::segments {

/// One bit for each pixel of a row, as the kernels write them.
class RowBits {
public:
  explicit RowBits(int width)
      : width_(width), words_((static_cast<std::size_t>(width) + kWord - 1) / kWord) {}

  [[nodiscard]] std::uint64_t* data() { return words_.data(); }
  [[nodiscard]] bool contains(int u) const {
    auto const i = static_cast<std::size_t>(u);
    return ((words_[i / kWord] >> (i % kWord)) & 1U) != 0;
  }
  /// The first 1 at u or behind; the width if there is none.
  [[nodiscard]] int next_set(int u) const { return next(u, 0); }
  /// The first 0 at u or behind; the width if there is none.
  [[nodiscard]] int next_clear(int u) const { return next(u, ~std::uint64_t{0}); }
  /// Calls `visit(u)` for each 1, from the left.
  template <typename Visit>
  void for_each_set(Visit const& visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      for (std::uint64_t rest = words_[w]; rest != 0; rest &= rest - 1) {
        visit(static_cast<int>(w * kWord) + std::countr_zero(rest));
      }
    }
  }

private:
  static constexpr std::size_t kWord = 64;

  [[nodiscard]] int next(int u, std::uint64_t flip) const {
    auto const begin = static_cast<std::size_t>(u);
    std::uint64_t mask = ~std::uint64_t{0} << (begin % kWord);
    for (std::size_t w = begin / kWord; w < words_.size(); ++w) {
      if (std::uint64_t const bits = (words_[w] ^ flip) & mask; bits != 0) {
        return std::min(width_, static_cast<int>(w * kWord) + std::countr_zero(bits));
      }
      mask = ~std::uint64_t{0};
    }
    return width_;
  }

  int width_;
  std::vector<std::uint64_t> words_;
};

}  // namespace credo::segments
