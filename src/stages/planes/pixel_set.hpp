#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bits.hpp"

namespace credo {

/// Some of an image's pixels: one bit each in raster order, 64 a word, so that passes skip what has
/// gone a word at a time.
class PixelSet {
public:
  static constexpr std::size_t kWordBits = credo::kWordBits;

  /// No pixel yet, of an image of so many.
  explicit PixelSet(std::size_t pixels) : words_((pixels + kWordBits - 1) / kWordBits, 0) {}

  /// Bits beyond the last pixel are 0.
  [[nodiscard]] std::span<std::uint64_t> words() { return words_; }
  [[nodiscard]] std::span<std::uint64_t const> words() const { return words_; }

  [[nodiscard]] bool contains(std::size_t pixel) const {
    return ((words_[pixel / kWordBits] >> (pixel % kWordBits)) & 1U) != 0;
  }
  void insert(std::size_t pixel) {
    words_[pixel / kWordBits] |= std::uint64_t{1} << (pixel % kWordBits);
  }
  void insert(PixelSet const& others) {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      words_[w] |= others.words_[w];
    }
  }
  void remove(PixelSet const& others) {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      words_[w] &= ~others.words_[w];
    }
  }

  /// Calls `visit(pixel)` for every `step`-th, in raster order, beginning with the first.
  template <typename Visit>
  void for_every(std::size_t step, Visit const& visit) const {
    std::size_t skip = 0;  // pixels to pass over before the next visit
    for (std::size_t w = 0; w < words_.size(); ++w) {
      std::uint64_t rest = words_[w];
      std::size_t count = count_bits(rest);
      for (; skip < count; count -= skip + 1, skip = step - 1) {
        for (std::size_t k = 0; k < skip; ++k) {
          rest &= rest - 1;
        }
        visit(w * kWordBits + static_cast<std::size_t>(std::countr_zero(rest)));
        rest &= rest - 1;
      }
      skip -= count;
    }
  }

  /// Calls `visit(pixel)` for each, in raster order.
  template <typename Visit>
  void for_each(Visit const& visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      for (std::uint64_t rest = words_[w]; rest != 0; rest &= rest - 1) {
        visit(w * kWordBits + static_cast<std::size_t>(std::countr_zero(rest)));
      }
    }
  }

  /// Calls `visit(begin, end)` for pixels side by side, in raster order; runs end with their word.
  template <typename Visit>
  void for_each_run(Visit const& visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      for (std::uint64_t rest = words_[w]; rest != 0;) {
        auto const first = static_cast<std::size_t>(std::countr_zero(rest));
        auto const count = static_cast<std::size_t>(std::countr_one(rest >> first));
        visit(w * kWordBits + first, w * kWordBits + first + count);
        // What the sum carries over lies beyond the run.
        rest &= rest + (std::uint64_t{1} << first);
      }
    }
  }

private:
  std::vector<std::uint64_t> words_;
};

/// Pixels, and how many they are.
struct CountedPixels {
  PixelSet pixels;
  std::size_t count = 0;

  /// One that is not among them yet.
  void insert(std::size_t pixel) {
    pixels.insert(pixel);
    ++count;
  }
  /// Some of a word, none of which are among them yet.
  void insert(std::size_t word, std::uint64_t bits) {
    pixels.words()[word] |= bits;
    count += count_bits(bits);
  }
  /// Others, none of which are among them yet.
  void insert(CountedPixels const& others) {
    pixels.insert(others.pixels);
    count += others.count;
  }
  [[nodiscard]] CountedPixels common(PixelSet const& others) const {
    CountedPixels result{pixels, 0};
    for (std::size_t w = 0; w < pixels.words().size(); ++w) {
      result.pixels.words()[w] &= others.words()[w];
      result.count += count_bits(result.pixels.words()[w]);
    }
    return result;
  }
  /// Takes out some of them: `others` must be a part of these.
  void remove(CountedPixels const& others) {
    pixels.remove(others.pixels);
    count -= others.count;
  }
};

/// Every pixel of an image of so many.
inline CountedPixels all_pixels(std::size_t pixels) {
  CountedPixels result{PixelSet(pixels), pixels};
  std::span<std::uint64_t> const words = result.pixels.words();
  std::ranges::fill(words, ~std::uint64_t{0});
  if (std::size_t const last = pixels % PixelSet::kWordBits; last != 0) {
    words.back() = (std::uint64_t{1} << last) - 1;
  }
  return result;
}

}  // namespace credo
