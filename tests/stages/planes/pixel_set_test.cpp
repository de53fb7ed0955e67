#include "stages/planes/pixel_set.hpp"

#include <gtest/gtest.h>

#include <vector>

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
