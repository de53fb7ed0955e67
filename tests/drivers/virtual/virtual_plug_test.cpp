// Sensors that go and come back while a client has them open.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "drivers/virtual/virtual_client.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Events : public openni::OpenNI::DeviceConnectedListener,
               public openni::OpenNI::DeviceDisconnectedListener {
public:
  Events() {
    openni::OpenNI::addDeviceConnectedListener(this);
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }
  Events(Events const&) = delete;
  Events& operator=(Events const&) = delete;
  Events(Events&&) = delete;
  Events& operator=(Events&&) = delete;
  ~Events() {
    openni::OpenNI::removeDeviceConnectedListener(this);
    openni::OpenNI::removeDeviceDisconnectedListener(this);
  }
  void onDeviceConnected(openni::DeviceInfo const* info) override {
    add(std::string("+") + info->getUri());
  }
  void onDeviceDisconnected(openni::DeviceInfo const* info) override {
    add(std::string("-") + info->getUri());
  }
  std::vector<std::string> wait_for(std::size_t count) {
    for (int i = 0; i < 2000; ++i) {
      {
        std::scoped_lock const lock(mutex_);
        if (seen_.size() >= count) {
          return seen_;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "no " << count << " events in 20 s";
    return {};
  }

private:
  void add(std::string event) {
    std::scoped_lock const lock(mutex_);
    seen_.push_back(std::move(event));
  }
  std::mutex mutex_;
  std::vector<std::string> seen_;
};

int devices() {
  openni::Array<openni::DeviceInfo> list;
  openni::OpenNI::enumerateDevices(&list);
  return list.getSize();
}

TEST_F(VirtualDriver, UnpluggedAndPluggedInAgain) {
  start_openni(R"({"sensors": [{"name": "a", "dataset": "a", "faults": [
    {"fault": "unplug", "at_frame": 20, "for_s": 2}]}, {"name": "b", "dataset": "b"}]})");
  Events events;
  {
    Client client("a");
    client.register_depth();
    client.start();
    auto const before = client.receive_until(1000, 700);
    ASSERT_FALSE(before.empty());
    EXPECT_LT(before.back().index, 20);
    EXPECT_THAT(events.wait_for(1), ElementsAre("-virtual://a"));
    EXPECT_EQ(devices(), 1);
    // OpenNI2 does not ask for what it has seen unplugged.
    EXPECT_THAT(error_of("virtual://a"), HasSubstr("Couldn't open device 'virtual://a'"));
    EXPECT_THAT(error_of("virtual://c"),
                HasSubstr("known are virtual://a (unplugged), virtual://b. "));
    EXPECT_THAT(events.wait_for(2), ElementsAre("-virtual://a", "+virtual://a"));
    EXPECT_EQ(devices(), 2);
    EXPECT_TRUE(client.receive_until(1000, 300).empty()) << "what was open stays dead";
  }
  auto const after = received_until(100);
  ASSERT_FALSE(after.empty());
  EXPECT_GE(after.front().index, 80);
  for (Received const& image : after) {
    EXPECT_EQ(image.data, pixels_of(image));
  }
}

TEST_F(VirtualDriver, UnpluggedForGood) {
  start_with_fault(R"({"fault": "unplug", "at_frame": 10})");
  Events events;
  Client client("a");
  client.start();
  client.receive_until(1000, 500);
  EXPECT_THAT(events.wait_for(1), ElementsAre("-virtual://a"));
  EXPECT_EQ(devices(), 0);
}

// As short as that, nobody would see it on the list; the devices are dead all the same.
TEST_F(VirtualDriver, ALooseContact) {
  start_with_fault(R"({"fault": "unplug", "at_frame": 10, "for_s": 0.0001},
                      {"fault": "unplug", "at_frame": 30, "for_s": 0.0001})");
  Events events;
  for (int i = 0; i < 2; ++i) {
    Client client("a");
    client.start();
    auto const all = client.receive_until(1000, 500);
    ASSERT_FALSE(all.empty());
    EXPECT_LT(all.back().index, 10 + 20 * i);
    events.wait_for(2U * static_cast<unsigned>(i) + 2);
  }
  EXPECT_THAT(events.wait_for(4),
              ElementsAre("-virtual://a", "+virtual://a", "-virtual://a", "+virtual://a"));
}

// A client may close from where it hears of it: no lock is held, and no stream's thread calls.
class CloseOnLoss : public openni::OpenNI::DeviceDisconnectedListener {
public:
  explicit CloseOnLoss(openni::Device& device) : device_(device) {
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }
  void onDeviceDisconnected(openni::DeviceInfo const* /*info*/) override {
    device_.close();
    closed_ = true;
  }
  [[nodiscard]] bool closed() const { return closed_; }

private:
  openni::Device& device_;
  std::atomic<bool> closed_ = false;
};

TEST_F(VirtualDriver, ClosedFromTheListener) {
  start_with_fault(R"({"fault": "unplug", "at_frame": 10, "for_s": 0.5})");
  Client client("a");
  CloseOnLoss listener(client.device());
  client.start();
  for (int i = 0; i < 2000 && !listener.closed(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(listener.closed());
  openni::OpenNI::removeDeviceDisconnectedListener(&listener);
}

}  // namespace
}  // namespace credo::test
