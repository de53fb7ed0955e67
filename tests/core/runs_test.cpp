#include "core/runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
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

TEST(Runs, OfTwoRowsEndWhereEitherChanges) {
  std::vector<std::uint8_t> const a = {1, 1, 1, 2, 2, 2, 2, 1};
  std::vector<std::int32_t> const b = {5, 5, 6, 6, 6, 7, 7, 7};
  std::vector<std::size_t> ends;
  std::size_t last = 0;
  for_each_run(std::span<std::uint8_t const>(a), std::span<std::int32_t const>(b),
               [&](std::size_t begin, std::size_t end) {
                 EXPECT_EQ(begin, last);
                 last = end;
                 ends.push_back(end);
               });
  EXPECT_EQ(ends, (std::vector<std::size_t>{2, 3, 5, 7, 8}));
}

}  // namespace
}  // namespace credo
