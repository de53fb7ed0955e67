#include "stages/planes/pixel_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "stages/planes/labelled_pixels.hpp"
#include "stages/planes/small_shots.hpp"

namespace credo {
namespace {

/// Every third pixel, and a run that fills two words.
PixelSet some_pixels(std::size_t size) {
  PixelSet set(size);
  for (std::size_t i = 0; i < size; ++i) {
    if (i % 3 == 1 || (i >= 128 && i < 256)) {
      set.insert(i);
    }
  }
  return set;
}

std::vector<std::size_t> every(PixelSet const& set, std::size_t step) {
  std::vector<std::size_t> pixels;
  set.for_every(step, [&](std::size_t i) { pixels.push_back(i); });
  return pixels;
}

TEST(PixelSet, VisitsItsPixelsInRasterOrder) {
  PixelSet const set = some_pixels(700);
  std::vector<std::size_t> visited;
  set.for_each([&](std::size_t i) { visited.push_back(i); });
  std::vector<std::size_t> expected;
  for (std::size_t i = 0; i < 700; ++i) {
    if (set.contains(i)) {
      expected.push_back(i);
    }
  }
  EXPECT_EQ(visited, expected);
  EXPECT_EQ(every(set, 1), expected);
}

TEST(PixelSet, VisitsEveryNthBeginningWithTheFirst) {
  PixelSet const set = some_pixels(700);
  std::vector<std::size_t> const all = every(set, 1);
  for (std::size_t const step : {2U, 3U, 7U, 63U, 64U, 65U, 200U, 1000U}) {
    std::vector<std::size_t> expected;
    for (std::size_t k = 0; k < all.size(); k += step) {
      expected.push_back(all[k]);
    }
    EXPECT_EQ(every(set, step), expected) << "step " << step;
  }
}

TEST(PixelSet, VisitsRunsThatEndWithTheirWord) {
  for (std::size_t const size : {0U, 1U, 64U, 130U, 700U}) {
    PixelSet const set = some_pixels(size);
    std::vector<std::size_t> visited;
    set.for_each_run([&](std::size_t begin, std::size_t end) {
      EXPECT_LT(begin, end);
      EXPECT_EQ(begin / PixelSet::kWordBits, (end - 1) / PixelSet::kWordBits);
      EXPECT_TRUE(end % PixelSet::kWordBits == 0 || !set.contains(end));
      for (std::size_t i = begin; i < end; ++i) {
        visited.push_back(i);
      }
    });
    EXPECT_EQ(visited, every(set, 1));
  }
}

TEST(PixelSet, OfAllPixels) {
  for (std::size_t const size : {0U, 1U, 63U, 64U, 65U, 700U}) {
    CountedPixels const all = all_pixels(size);
    CountedPixels const each = test::pixels_where(size, [](std::size_t /*i*/) { return true; });
    EXPECT_EQ(all.count, size);
    EXPECT_TRUE(std::ranges::equal(all.pixels.words(), each.pixels.words()));
  }
}

TEST(PixelSet, OfPixelsWithALabel) {
  for (int const width : {0, 1, 63, 64, 65, 700}) {
    LabelMap labels(width, 1, kUnassigned);
    for (int u = 0; u < width; u += 3) {
      labels[{u, 0}] = u % 2 == 0 ? kNoDepth : kFloor;
    }
    for (auto const& [found, wanted] :
         {std::pair(pixels_labelled(labels, kFloor),
                    test::pixels_where(labels.size(), [&](auto i) { return labels[i] == kFloor; })),
          std::pair(pixels_with_depth(labels), test::pixels_where(labels.size(), [&](auto i) {
                      return labels[i] != kNoDepth;
                    }))}) {
      EXPECT_EQ(found.count, wanted.count);
      EXPECT_TRUE(std::ranges::equal(found.pixels.words(), wanted.pixels.words()));
    }
  }
}

TEST(PixelSet, CountsWhatComesInManyAtOnce) {
  CountedPixels pixels = test::pixels_where(200, [](std::size_t i) { return i % 2 == 0; });
  pixels.insert(1, std::uint64_t{2});
  EXPECT_TRUE(pixels.pixels.contains(65));
  EXPECT_EQ(pixels.count, 101U);
  pixels.insert(test::pixels_where(200, [](std::size_t i) { return i == 67 || i == 69; }));
  EXPECT_TRUE(pixels.pixels.contains(69));
  EXPECT_EQ(pixels.count, 103U);
}

TEST(PixelSet, TakesOutWhatItIsTold) {
  PixelSet set = some_pixels(200);
  PixelSet gone(200);
  gone.insert(130);
  gone.insert(2);  // not in the set
  set.remove(gone);
  EXPECT_FALSE(set.contains(130));
  EXPECT_FALSE(set.contains(2));
  EXPECT_TRUE(set.contains(131));
}

TEST(PixelSet, OfAnEmptyImageIsEmpty) {
  EXPECT_TRUE(every(PixelSet(0), 1).empty());
  EXPECT_TRUE(every(PixelSet(100), 5).empty());
}

}  // namespace
}  // namespace credo
