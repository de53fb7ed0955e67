#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace credo {

inline constexpr std::size_t kWordBits = 64;

/// std::popcount is a call where the compiler may not assume the instruction.
[[nodiscard]] constexpr std::size_t count_bits(std::uint64_t bits) {
  // Sums of two, of four, of eight, then of all in the uppermost byte.
  bits -= (bits >> 1U) & 0x5555555555555555U;
  bits = (bits & 0x3333333333333333U) + ((bits >> 2U) & 0x3333333333333333U);
  bits = (bits + (bits >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
  return static_cast<std::size_t>((bits * 0x0101010101010101U) >> 56U);
}

/// Bit i tells whether `test(i)`, for up to 64; those beyond `count` are 0.
template <typename Test>
[[nodiscard]] std::uint64_t bits_where(std::size_t count, Test const& test) {
  std::array<std::uint8_t, kWordBits> passes{};
  // A loop of its own, so that it vectorises.
  for (std::size_t i = 0; i < count; ++i) {
    passes[i] = test(i) ? 1 : 0;
  }
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < passes.size(); i += 8) {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t eight = 0;
    std::memcpy(&eight, passes.data() + i, sizeof eight);
    // The product's uppermost byte holds the lowest bit of each of the eight.
    bits |= ((eight * 0x0102040810204080U) >> 56U) << i;
  }
  return bits;
}

}  // namespace credo
