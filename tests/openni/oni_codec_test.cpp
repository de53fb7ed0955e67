#include "openni/oni_codec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;
using Bytes = std::vector<unsigned char>;

TEST(Oni16z, FirstValueThenSmallSteps) {
  // 0 is 6 more, 6 is the same, 12 is 6 less.
  EXPECT_THAT(unpack_16z(Bytes{0xE8, 0x03, 0x06, 0xC7}, 5),
              Optional(ElementsAre(1000, 1006, 1006, 1000, 999)));
}

TEST(Oni16z, FillerIsNoValue) {
  EXPECT_THAT(unpack_16z(Bytes{0xE8, 0x03, 0x5D}, 2), Optional(ElementsAre(1000, 1001)));
}

TEST(Oni16z, RepeatsInPairs) {
  EXPECT_THAT(unpack_16z(Bytes{0x00, 0x00, 0xE2}, 5), Optional(ElementsAre(0, 0, 0, 0, 0)));
}

TEST(Oni16z, LargeStepsAndWholeValues) {
  // After a high half of 15 its byte's low half says nothing; after a low one all is used.
  EXPECT_THAT(unpack_16z(Bytes{0xE8, 0x03, 0xFF, 0xC5, 0x6F, 0x12, 0x34, 0xF0, 0x80}, 5),
              Optional(ElementsAre(1000, 995, 995, 0x1234, 0x1234 + 64)));
}

TEST(Oni16z, WhatDoesNotComeOutIsDamaged) {
  EXPECT_EQ(unpack_16z(Bytes{}, 0), std::nullopt);
  EXPECT_EQ(unpack_16z(Bytes{0xE8}, 1), std::nullopt);
  EXPECT_EQ(unpack_16z(Bytes{0xE8, 0x03, 0x66}, 2), std::nullopt) << "one too many";
  EXPECT_EQ(unpack_16z(Bytes{0xE8, 0x03, 0x66}, 4), std::nullopt) << "one too few";
  EXPECT_EQ(unpack_16z(Bytes{0xE8, 0x03, 0xF0, 0x12}, 2), std::nullopt) << "half a value";
  EXPECT_EQ(unpack_16z(Bytes{0xE8, 0x03, 0xFF}, 2), std::nullopt) << "no value";
  EXPECT_EQ(unpack_16z(Bytes{0xE8, 0x03, 0x6E}, 2), std::nullopt) << "a repeat as a low half";
}

TEST(Oni16z, TableComesFirst) {
  Bytes const bytes{2, 0, 0xE8, 0x03, 0xD0, 0x07, 1, 0, 0x76};
  EXPECT_THAT(unpack_16z_with_table(bytes, 3), Optional(ElementsAre(2000, 1000, 1000)));
  EXPECT_EQ(unpack_16z_with_table(Bytes{2, 0, 0xE8, 0x03, 0xD0, 0x07, 2, 0}, 1), std::nullopt)
      << "beyond the table";
  EXPECT_EQ(unpack_16z_with_table(Bytes{9, 0, 0xE8, 0x03}, 1), std::nullopt) << "half a table";
  EXPECT_EQ(unpack_16z_with_table(Bytes{9}, 1), std::nullopt);
}

}  // namespace
}  // namespace credo::test
