#include "stages/planes/segment_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace credo {
namespace {

/// Segments 0 to 5 in runs of 1 to 150 pixels, and every so many-th pixel of the image.
struct Image {
  Segments segments;
  PixelSet pixels;

  Image(int width, int height, std::size_t every, unsigned seed)
      : pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    std::mt19937 random(seed);
    segments.labels = Grid<std::int32_t>(width, height);
    segments.pixel_counts.assign(5, 0);
    std::size_t end = 0;
    std::int32_t label = 0;
    for (std::size_t i = 0; i < segments.labels.size(); ++i) {
      if (i == end) {
        end += 1 + random() % 150;
        label = static_cast<std::int32_t>(random() % 6);
      }
      segments.labels[i] = label;
      if (i % every == 0) {
        pixels.insert(i);
      }
    }
  }
};

TEST(SegmentPieces, CountAndChooseAsPixelsDo) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Image const image(37 + static_cast<int>(seed), 21, 1 + seed % 4, seed);
    SegmentPieces const pieces(image.segments);
    std::vector<std::uint32_t> counts(6, 0);
    CountedPixels odd{PixelSet(image.segments.labels.size()), 0};
    image.pixels.for_each([&](std::size_t i) {
      auto const segment = static_cast<std::size_t>(image.segments.labels[i]);
      ++counts[segment];
      if (segment % 2 == 1) {
        odd.insert(i);
      }
    });
    EXPECT_EQ(pieces.counts(image.pixels), counts);
    CountedPixels const chosen =
        pieces.where(image.pixels, [](std::size_t segment) { return segment % 2 == 1; });
    EXPECT_EQ(chosen.count, odd.count);
    EXPECT_TRUE(std::ranges::equal(chosen.pixels.words(), odd.pixels.words()));
  }
}

TEST(SegmentPieces, WithoutSegmentsThereAreNone) {
  Segments const none;
  SegmentPieces const pieces(none);
  EXPECT_TRUE(pieces.empty());
  EXPECT_TRUE(pieces.counts(PixelSet(100)).empty());
}

}  // namespace
}  // namespace credo
