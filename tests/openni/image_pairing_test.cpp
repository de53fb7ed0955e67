#include "openni/image_pairing.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <utility>

namespace credo {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Images of one pixel, which is their stamp.
DepthImage depth(std::int64_t ms) {
  return {ms * kMs, {}, Grid<std::uint16_t>(1, 1, static_cast<std::uint16_t>(ms))};
}
ColorImage color(std::int64_t ms) {
  return {ms * kMs, Grid<Rgb>(1, 1, Rgb{static_cast<std::uint8_t>(ms), 0, 0})};
}

/// The stamps of a pair [ms]; colour -1 where it has none.
std::pair<int, int> stamps(std::optional<ImagePair> const& pair) {
  return {pair->depth.counts[0], pair->color.empty() ? -1 : pair->color[0][0]};
}

using Stamps = std::pair<int, int>;

TEST(ImagePairing, DepthWaitsForItsColour) {
  ImagePairing pairing;
  pairing.add(depth(33));
  EXPECT_FALSE(pairing.take());
  EXPECT_TRUE(pairing.is_waiting());
  pairing.add(color(34));
  EXPECT_EQ(stamps(pairing.take()), Stamps(33, 34));
  EXPECT_FALSE(pairing.is_waiting());
  EXPECT_FALSE(pairing.take());
}

TEST(ImagePairing, TheNearestColourCounts) {
  ImagePairing pairing;
  for (int ms : {10, 30, 50}) {
    pairing.add(color(ms));
  }
  pairing.add(depth(33));
  EXPECT_EQ(stamps(pairing.take()), Stamps(33, 30));
}

TEST(ImagePairing, WhatIsHalfAFrameAwayIsAnotherFrames) {
  ImagePairing pairing;
  pairing.add(color(50));
  pairing.add(depth(33));
  EXPECT_EQ(stamps(pairing.take()), Stamps(33, -1));  // 17 ms
  pairing.add(color(82));
  pairing.add(depth(66));
  EXPECT_EQ(stamps(pairing.take()), Stamps(66, 50));  // 16 ms either way: the first
}

TEST(ImagePairing, DepthIsNeverDropped) {
  ImagePairing pairing;
  pairing.add(depth(33));
  pairing.add(depth(66));
  EXPECT_EQ(stamps(pairing.take()), Stamps(33, -1));
  EXPECT_FALSE(pairing.take());
  EXPECT_EQ(stamps(pairing.take_now()), Stamps(66, -1));
  EXPECT_FALSE(pairing.take_now());
}

TEST(ImagePairing, WithoutColourNothingWaits) {
  ImagePairing pairing;
  pairing.expect_color(false);
  pairing.add(depth(33));
  EXPECT_EQ(stamps(pairing.take()), Stamps(33, -1));
}

TEST(ImagePairing, NothingIsLeftOfAnotherConnection) {
  ImagePairing pairing;
  pairing.add(color(33));
  pairing.add(depth(66));
  pairing.add(depth(99));
  pairing.clear();
  EXPECT_FALSE(pairing.take_now());
  pairing.add(depth(33));
  EXPECT_EQ(stamps(pairing.take_now()), Stamps(33, -1));
}

}  // namespace
}  // namespace credo
