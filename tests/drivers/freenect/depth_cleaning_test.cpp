#include "drivers/freenect/depth_cleaning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace credo::freenect::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FalseDepths, AreBeyondInfinity) {
  std::vector<std::uint16_t> const table = {0, 400, 500, 9999, 10000, 40000, 6351, 0, 65000, 3755};
  EXPECT_THAT(false_depths_mm(table), ElementsAre(6351, 3755));
}

TEST(FalseDepths, ATableWithoutInfinityHasNone) {
  EXPECT_THAT(false_depths_mm(std::vector<std::uint16_t>{0, 400, 9999, 300}), IsEmpty());
  EXPECT_THAT(false_depths_mm({}), IsEmpty());
}

/// As it is said, one after the other.
std::vector<std::uint16_t> literally_cleaned(std::vector<std::uint16_t> depths_mm,
                                             std::vector<std::uint16_t> const& false_ones) {
  for (std::uint16_t& depth_mm : depths_mm) {
    bool const is_false = std::ranges::find(false_ones, depth_mm) != false_ones.end();
    depth_mm = depth_mm >= 10000 || is_false ? 0 : depth_mm;
  }
  return depths_mm;
}

TEST(DepthCleaner, EqualsTheLiteralOneForAllDepths) {
  std::vector<std::uint16_t> all;
  for (int depth_mm = 0; depth_mm <= 65535; ++depth_mm) {
    all.push_back(static_cast<std::uint16_t>(depth_mm));
  }
  for (std::vector<std::uint16_t> const& false_ones :
       {std::vector<std::uint16_t>{}, {6351, 3755}, {1, 9999, 10000, 65535}}) {
    std::vector<std::uint16_t> cleaned(all.size(), 7);
    DepthCleaner(false_ones).clean(all, cleaned);
    EXPECT_EQ(cleaned, literally_cleaned(all, false_ones));
  }
}

TEST(DepthCleaner, NeedsRoomForAll) {
  std::vector<std::uint16_t> const depths(4);
  std::vector<std::uint16_t> cleaned(3);
  EXPECT_THROW(DepthCleaner().clean(depths, cleaned), std::logic_error);
  EXPECT_NO_THROW(DepthCleaner().clean({}, {}));
}

}  // namespace
}  // namespace credo::freenect::test
