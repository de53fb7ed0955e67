#include "geometry/label_bits.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "support/instruction_sets.hpp"

namespace credo {
namespace {

constexpr std::uint64_t kGuard = 0x1234567890ABCDEFU;

template <typename Check>
void for_each_size(Check const& check) {
  test::on_every_instruction_set([&] {
    for (std::size_t const count : {0U, 1U, 2U, 63U, 64U, 65U, 128U, 129U, 640U, 1024U, 1100U}) {
      SCOPED_TRACE(count);
      check(count);
    }
  });
}

/// Two bits of each label that change, high ones among them.
template <typename T>
std::vector<T> drawn(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<T> labels(count);
  for (T& label : labels) {
    label = static_cast<T>(random() % 2 << (random() % (8 * sizeof(T) - 1)));
  }
  return labels;
}

/// Of a plain loop.
template <typename Test>
std::vector<std::uint64_t> plain_bits(std::size_t count, Test const& test) {
  std::vector<std::uint64_t> bits((count + 63) / 64, 0);
  for (std::size_t i = 0; i < count; ++i) {
    bits[i / 64] |= std::uint64_t{test(i)} << (i % 64);
  }
  return bits;
}

/// What `mark` writes, which is as many words as there are labels for.
template <typename Mark>
std::vector<std::uint64_t> written_bits(std::size_t count, Mark const& mark) {
  std::vector<std::uint64_t> bits((count + 63) / 64 + 1, kGuard);
  mark(bits.data());
  EXPECT_EQ(bits.back(), kGuard);
  bits.pop_back();
  return bits;
}

template <typename T>
void expect_different_are_marked(std::size_t count) {
  std::vector<T> const a = drawn<T>(count, 1);
  std::vector<T> const b = drawn<T>(count, 2);
  EXPECT_EQ(
      written_bits(count,
                   [&](std::uint64_t* bits) { mark_different(a.data(), b.data(), count, bits); }),
      plain_bits(count, [&](std::size_t i) { return a[i] != b[i]; }));
}

TEST(LabelBits, AreOneWhereLabelsDiffer) {
  for_each_size(expect_different_are_marked<std::int32_t>);
  for_each_size(expect_different_are_marked<LabelCode>);
}

TEST(LabelBits, AreOneWhereItIsThatLabel) {
  for_each_size([](std::size_t count) {
    std::vector<LabelCode> const labels = drawn<LabelCode>(count, 3);
    for (auto const label : {LabelCode{0}, LabelCode{1}, LabelCode{0x4000}}) {
      EXPECT_EQ(
          written_bits(count,
                       [&](std::uint64_t* bits) { mark_equal(labels.data(), label, count, bits); }),
          plain_bits(count, [&](std::size_t i) { return labels[i] == label; }));
    }
  });
}

using Ends = std::vector<std::pair<std::size_t, std::size_t>>;

Ends runs_of(std::vector<LabelCode> const& codes, std::vector<std::int32_t> const& segments) {
  Ends runs;
  for_each_run(codes, segments,
               [&](std::size_t begin, std::size_t end) { runs.emplace_back(begin, end); });
  return runs;
}

TEST(LabelRuns, EndWhereEitherRowChanges) {
  EXPECT_EQ(runs_of({1, 1, 1, 2, 2, 2, 2, 1}, {5, 5, 6, 6, 6, 7, 7, 7}),
            (Ends{{0, 2}, {2, 3}, {3, 5}, {5, 7}, {7, 8}}));
}

TEST(LabelRuns, AreThoseOfAPlainLoop) {
  for_each_size([](std::size_t count) {
    std::mt19937 random(1);
    for (unsigned const most : {1U, 2U, 20U, 3000U}) {
      std::vector<LabelCode> codes(count);
      std::vector<std::int32_t> segments(count);
      for (std::size_t i = 1; i < count; ++i) {
        codes[i] = static_cast<LabelCode>(codes[i - 1] + (random() % most == 0 ? 1 : 0));
        segments[i] = segments[i - 1] - (random() % most == 0 ? 1 : 0);
      }
      Ends expected;
      for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
        for (end = begin + 1;
             end < count && codes[end] == codes[begin] && segments[end] == segments[begin];) {
          ++end;
        }
        expected.emplace_back(begin, end);
      }
      EXPECT_EQ(runs_of(codes, segments), expected);
    }
  });
}

}  // namespace
}  // namespace credo
