#include "drivers/virtual/image_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace credo::test {
namespace {

using ::testing::ElementsAre;

Grid<int> const kImage(3, 2, {1, 2, 3, 4, 5, 6});

TEST(ImageView, TheWholeImageIsItself) {
  std::array<int, 6> out{};
  copy_view(kImage, {false, 0, 0, 3, 2}, out.data());
  EXPECT_THAT(out, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(ImageView, MirrorsLeftAndRight) {
  std::array<int, 6> out{};
  copy_view(kImage, {true, 0, 0, 3, 2}, out.data());
  EXPECT_THAT(out, ElementsAre(3, 2, 1, 6, 5, 4));
}

TEST(ImageView, CutsWhatWasMirrored) {
  std::array<int, 2> out{};
  copy_view(kImage, {true, 1, 1, 2, 1}, out.data());
  EXPECT_THAT(out, ElementsAre(5, 4));
  copy_view(kImage, {false, 1, 1, 2, 1}, out.data());
  EXPECT_THAT(out, ElementsAre(5, 6));
}

TEST(Garbage, IsTheSameForTheSameSeed) {
  std::array<unsigned char, 64> a{};
  std::array<unsigned char, 64> b{};
  fill_with_garbage(1, a.data(), a.size());
  fill_with_garbage(1, b.data(), b.size());
  EXPECT_EQ(a, b);
  fill_with_garbage(2, b.data(), b.size());
  EXPECT_NE(a, b);
}

}  // namespace
}  // namespace credo::test
