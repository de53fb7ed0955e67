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

}  // namespace
}  // namespace credo
