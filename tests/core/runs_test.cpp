#include "core/runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace credo {
namespace {

TEST(Runs, EndWhereTheValueDoes) {
  for (std::size_t size = 1; size < 60; ++size) {
    for (std::size_t other = 1; other <= size; ++other) {
      std::vector<std::int32_t> values(size, 7);
      std::fill(values.begin() + static_cast<std::ptrdiff_t>(other), values.end(), 8);
      for (std::size_t begin = 0; begin < size; ++begin) {
        EXPECT_EQ(run_end(std::span<std::int32_t const>(values), begin),
                  begin < other ? other : size);
      }
    }
  }
}

TEST(Runs, EndAtASingleOtherValue) {
  std::vector<std::uint8_t> values(100, 1);
  values[77] = 0;
  EXPECT_EQ(run_end(std::span<std::uint8_t const>(values), 3), 77U);
  EXPECT_EQ(run_end(std::span<std::uint8_t const>(values), 77), 78U);
  EXPECT_EQ(run_end(std::span<std::uint8_t const>(values), 78), 100U);
}

}  // namespace
}  // namespace credo
