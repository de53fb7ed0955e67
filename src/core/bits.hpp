#pragma once

#include <cstddef>
#include <cstdint>

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

}  // namespace credo
