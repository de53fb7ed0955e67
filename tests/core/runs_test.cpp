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

TEST(Runs, OfTwoRowsAreThoseOfAPlainLoop) {
  std::mt19937 random(1);
  for (std::size_t const size : {0U, 1U, 2U, 63U, 64U, 65U, 66U, 128U, 129U, 640U}) {
    for (unsigned const most : {1U, 2U, 20U}) {
      std::vector<std::uint16_t> a(size);
      std::vector<std::int32_t> b(size);
      for (std::size_t i = 1; i < size; ++i) {
        a[i] = random() % most == 0 ? static_cast<std::uint16_t>(a[i - 1] + 1) : a[i - 1];
        b[i] = random() % most == 0 ? b[i - 1] - 1 : b[i - 1];
      }
      std::vector<std::pair<std::size_t, std::size_t>> expected;
      for (std::size_t begin = 0, end = 0; begin < size; begin = end) {
        for (end = begin + 1; end < size && a[end] == a[begin] && b[end] == b[begin];) {
          ++end;
        }
        expected.emplace_back(begin, end);
      }
      std::vector<std::pair<std::size_t, std::size_t>> runs;
      for_each_run(std::span<std::uint16_t const>(a), std::span<std::int32_t const>(b),
                   [&](std::size_t begin, std::size_t end) { runs.emplace_back(begin, end); });
      EXPECT_EQ(runs, expected);
    }
  }
}

}  // namespace
}  // namespace credo
