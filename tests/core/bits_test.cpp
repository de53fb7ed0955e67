#include "core/bits.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>

namespace credo {
namespace {

TEST(Bits, AreCounted) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 1000; ++k) {
    std::uint64_t const bits = random() & (random() | random());
    EXPECT_EQ(count_bits(bits), static_cast<std::size_t>(std::popcount(bits)));
  }
  EXPECT_EQ(count_bits(0), 0U);
  EXPECT_EQ(count_bits(~std::uint64_t{0}), 64U);
}

TEST(Bits, TellWhatPasses) {
  std::mt19937_64 random(1);
  for (std::size_t count = 0; count <= kWordBits; ++count) {
    std::uint64_t const wanted = random();
    std::uint64_t const within = count < kWordBits ? (std::uint64_t{1} << count) - 1 : ~0ULL;
    EXPECT_EQ(bits_where(count, [&](std::size_t i) { return ((wanted >> i) & 1U) != 0; }),
              wanted & within);
  }
}

}  // namespace
}  // namespace credo
