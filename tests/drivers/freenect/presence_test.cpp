#include "drivers/freenect/presence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace credo::freenect::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(PresenceRecord, TellsWhoCameAndWhoWent) {
  PresenceRecord record;
  EXPECT_THAT(record.update({{"A", "B"}, 0}).came, ElementsAre("A", "B"));
  PresenceChanges const changes = record.update({{"B", "C"}, 0});
  EXPECT_THAT(changes.came, ElementsAre("C"));
  EXPECT_THAT(changes.went, ElementsAre("A"));
  EXPECT_FALSE(changes.unreadable);
  PresenceChanges const same = record.update({{"C", "B"}, 0});
  EXPECT_THAT(same.came, IsEmpty());
  EXPECT_THAT(same.went, IsEmpty());
}

TEST(PresenceRecord, ASerialCountsOnce) {
  PresenceRecord record;
  EXPECT_THAT(record.update({{"0", "0"}, 0}).came, ElementsAre("0"));
  EXPECT_THAT(record.update({{"0"}, 0}).went, IsEmpty());
  record.update({{"0", "0"}, 0});
  EXPECT_THAT(record.update({{}, 0}).went, ElementsAre("0"));
}

TEST(PresenceRecord, TellsTheUnreadableOnceForEachNumber) {
  PresenceRecord record;
  EXPECT_FALSE(record.update({{}, 0}).unreadable);
  EXPECT_EQ(record.update({{}, 1}).unreadable, 1);
  EXPECT_FALSE(record.update({{}, 1}).unreadable);
  EXPECT_EQ(record.update({{"A"}, 0}).unreadable, 0);
}

TEST(PresenceRecord, WhatIsForgottenComesAgain) {
  PresenceRecord record;
  record.update({{"A"}, 0});
  record.forget("A");
  EXPECT_THAT(record.update({{"A"}, 0}).came, ElementsAre("A"));
  record.forget("A");
  EXPECT_THAT(record.update({{}, 0}).went, IsEmpty());
}

}  // namespace
}  // namespace credo::freenect::test
