#include "geometry/few_draws.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace credo {
namespace {

TEST(FewDraws, AreThoseOfTheStandardLibrary) {
  for (std::uint32_t const seed : {0U, 1U, 5489U, 0xFFFFFFFFU}) {
    std::mt19937 expected(seed);
    FewDraws draws(seed);
    // More than two rounds of its state.
    for (int k = 0; k < 1500; ++k) {
      ASSERT_EQ(draws(), expected()) << "draw " << k << " of seed " << seed;
    }
  }
}

}  // namespace
}  // namespace credo
