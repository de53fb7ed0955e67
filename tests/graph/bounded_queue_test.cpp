#include "graph/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace credo {
namespace {

constexpr auto kAny = [](std::string const&) { return true; };

void append_dropped(std::string dropped, std::string& next) {
  next = std::move(dropped) + "+" + next;
}

BoundedQueue<std::string> queue_of(std::size_t capacity, Overflow overflow) {
  return {capacity, overflow, append_dropped};
}

void write(BoundedQueue<std::string>& queue, std::string value) {
  ASSERT_TRUE(queue.try_reserve());
  queue.push(std::move(value));
}

TEST(BoundedQueue, GivesValuesInOrder) {
  auto queue = queue_of(3, Overflow::kWait);
  write(queue, "a");
  write(queue, "b");
  EXPECT_EQ(queue.try_pop(kAny), "a");
  write(queue, "c");
  EXPECT_EQ(queue.try_pop(kAny), "b");
  EXPECT_EQ(queue.try_pop(kAny), "c");
  EXPECT_EQ(queue.try_pop(kAny), std::nullopt);
}

TEST(BoundedQueue, ReservationsCountAsRoomTaken) {
  auto queue = queue_of(2, Overflow::kWait);
  write(queue, "a");
  EXPECT_TRUE(queue.try_reserve());
  EXPECT_FALSE(queue.try_reserve());
  queue.release();
  EXPECT_TRUE(queue.try_reserve());
  queue.push("b");
  EXPECT_FALSE(queue.try_reserve());
  EXPECT_EQ(queue.try_pop(kAny), "a");
  EXPECT_TRUE(queue.try_reserve());
}

TEST(BoundedQueue, DropsTheOldestAndTellsTheNext) {
  auto queue = queue_of(2, Overflow::kDropOldest);
  for (char const* value : {"a", "b", "c", "d"}) {
    write(queue, value);
  }
  EXPECT_EQ(queue.try_pop(kAny), "a+b+c");
  EXPECT_EQ(queue.try_pop(kAny), "d");
  EXPECT_EQ(queue.stats().dropped, 2U);
  EXPECT_EQ(queue.stats().peak, 2U);
}

TEST(BoundedQueue, WithRoomForOneTheNewcomerInherits) {
  auto queue = queue_of(1, Overflow::kDropOldest);
  for (char const* value : {"a", "b", "c"}) {
    write(queue, value);
  }
  EXPECT_EQ(queue.try_pop(kAny), "a+b+c");
  EXPECT_EQ(queue.stats().peak, 1U);
}

TEST(BoundedQueue, KeepsTheHeadUntilItIsReady) {
  auto queue = queue_of(2, Overflow::kWait);
  write(queue, "a");
  write(queue, "b");
  EXPECT_EQ(queue.try_pop([](std::string const& head) { return head == "b"; }), std::nullopt);
  EXPECT_EQ(queue.try_pop([](std::string const& head) { return head == "a"; }), "a");
}

TEST(BoundedQueue, AWriterThatMayWaitDoesUntilThereIsRoom) {
  auto queue = queue_of(1, Overflow::kWait);
  write(queue, "a");
  std::jthread writer([&] {
    queue.wait_and_reserve();
    queue.push("b");
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(queue.try_pop(kAny), "a");
  writer.join();
  EXPECT_EQ(queue.try_pop(kAny), "b");
  EXPECT_EQ(queue.stats().peak, 1U);
}

TEST(BoundedQueue, RefusesBrokenContracts) {
  EXPECT_THROW(queue_of(0, Overflow::kWait), std::logic_error);
  auto queue = queue_of(1, Overflow::kWait);
  EXPECT_THROW(queue.push("unreserved"), std::logic_error);
  EXPECT_THROW(queue.release(), std::logic_error);
}

}  // namespace
}  // namespace credo
