#include "drivers/freenect/monitor.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace credo::freenect::test {
namespace {

TEST(Monitor, LooksOverAndOverUntilItIsStopped) {
  std::atomic<int> reports = 0;
  std::atomic<int> looks = 0;
  Monitor monitor;
  monitor.stop();  // does not run yet
  monitor.start([&] { ++reports; }, [&] { ++looks; });
  while (looks < 2) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  monitor.stop();
  EXPECT_GE(reports, 10) << "five for each look";
  EXPECT_LE(looks, reports / 5);
  int const before = reports;
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  EXPECT_EQ(reports, before);
}

// Nobody waits for the end of a tick.
TEST(Monitor, GoesWithItsThread) {
  std::atomic<int> reports = 0;
  {
    Monitor monitor;
    monitor.start([&] { ++reports; }, [] {});
  }
  int const before = reports;
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  EXPECT_EQ(reports, before);
}

}  // namespace
}  // namespace credo::freenect::test
