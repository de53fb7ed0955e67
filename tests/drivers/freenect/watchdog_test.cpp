#include "drivers/freenect/watchdog.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>

namespace credo::freenect::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Watchdog::Clock::time_point kBegin{};

TEST(Watchdog, IsQuietWhereTheStreamDoesNotRun) {
  Watchdog dog;
  EXPECT_FALSE(dog.runs());
  dog.frame_came(kBegin);
  EXPECT_FALSE(dog.runs());
  EXPECT_EQ(dog.bark(kBegin + seconds(100)), std::nullopt);
  dog.start(kBegin);
  EXPECT_TRUE(dog.runs());
  dog.stop();
  EXPECT_EQ(dog.bark(kBegin + seconds(100)), std::nullopt);
}

TEST(Watchdog, BarksTwoSecondsAfterTheLastFrame) {
  Watchdog dog;
  dog.start(kBegin);
  EXPECT_EQ(dog.bark(kBegin + milliseconds(1'999)), std::nullopt);
  dog.frame_came(kBegin + seconds(1));
  EXPECT_EQ(dog.bark(kBegin + milliseconds(2'999)), std::nullopt);
  EXPECT_EQ(dog.bark(kBegin + seconds(3)), seconds(2));
}

TEST(Watchdog, WaitsTwiceAsLongEachTimeUpToHalfAMinute) {
  Watchdog dog;
  dog.start(kBegin);
  auto now = kBegin;
  for (int const patience_s : {2, 4, 8, 16, 30, 30, 30}) {
    now += seconds(patience_s);
    EXPECT_EQ(dog.bark(now - milliseconds(1)), std::nullopt) << patience_s;
    EXPECT_EQ(dog.bark(now), seconds(patience_s));
  }
}

TEST(Watchdog, AFrameOrAStartMakesItWatchCloselyAgain) {
  Watchdog dog;
  dog.start(kBegin);
  EXPECT_EQ(dog.bark(kBegin + seconds(2)), seconds(2));
  EXPECT_EQ(dog.bark(kBegin + seconds(6)), seconds(4));
  dog.frame_came(kBegin + seconds(7));
  EXPECT_EQ(dog.bark(kBegin + seconds(9)), seconds(2));
  dog.stop();
  dog.start(kBegin + seconds(10));
  EXPECT_EQ(dog.bark(kBegin + seconds(12)), seconds(2));
}

}  // namespace
}  // namespace credo::freenect::test
