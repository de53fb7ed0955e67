#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "drivers/freenect/rig.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

int listed() {
  openni::Array<openni::DeviceInfo> list;
  openni::OpenNI::enumerateDevices(&list);
  return list.getSize();
}

TEST(HotPlug, WithoutAKinectOpenNIStarts) {
  Rig const rig({});
  EXPECT_EQ(listed(), 0);
  openni::Device device;
  EXPECT_NE(device.open(uri_of("A").c_str()), openni::STATUS_OK);
  EXPECT_THAT(openni_error(), HasSubstr("no Kinect of this serial number is plugged in"));
}

TEST(HotPlug, ComesAndGoesUnopened) {
  Rig const rig({kinect("A")});
  Events events;
  EXPECT_EQ(listed(), 1);
  fake_usb::plug(kinect("B"));
  EXPECT_TRUE(events.wait_for("+" + uri_of("B")));
  EXPECT_EQ(listed(), 2);
  fake_usb::unplug("B");
  EXPECT_TRUE(events.wait_for("-" + uri_of("B")));
  EXPECT_EQ(listed(), 1);
}

TEST(HotPlug, TellsWhatItIs) {
  Rig const rig({kinect("A")});
  openni::Array<openni::DeviceInfo> list;
  openni::OpenNI::enumerateDevices(&list);
  ASSERT_EQ(list.getSize(), 1);
  EXPECT_STREQ(list[0].getUri(), "freenect://A");
  EXPECT_STREQ(list[0].getName(), "Kinect");
  EXPECT_EQ(list[0].getUsbVendorId(), 0x045E);
  openni::Device device;
  ASSERT_EQ(device.open(openni::ANY_DEVICE), openni::STATUS_OK) << openni_error();
  char serial[16] = {};
  int size = sizeof(serial);
  EXPECT_EQ(device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size),
            openni::STATUS_OK);
  EXPECT_STREQ(serial, "A");
}

// Again and again, with both streams on; the old one stays dead, the new one runs.
TEST(HotPlug, UnpluggedWhileItStreamsAndPluggedInAgain) {
  Rig const rig({kinect("A")});
  for (int i = 0; i < 3; ++i) {
    Events events;
    Client client("A");
    ASSERT_EQ(client.depth.start(), openni::STATUS_OK) << openni_error();
    ASSERT_EQ(client.color.start(), openni::STATUS_OK) << openni_error();
    ASSERT_TRUE(read(client.depth) && read(client.color));
    fake_usb::unplug("A");
    EXPECT_TRUE(events.wait_for("-" + uri_of("A")));
    EXPECT_EQ(listed(), 0);
    fake_usb::plug(kinect("A"));
    EXPECT_TRUE(events.wait_for("+" + uri_of("A")));
    EXPECT_EQ(listed(), 1);
    client.close();
    EXPECT_THAT(events.all(), ElementsAre("-" + uri_of("A"), "+" + uri_of("A")));
    EXPECT_EQ(fake_usb::usage("A").misuses, 0);
  }
}

// In the wrong order: OpenNI still stops the streams of the closed device.
TEST(HotPlug, UnpluggedAndClosedBeforeItsStreamsAreStopped) {
  Rig const rig({kinect("A")});
  Events events;
  Client client("A");
  ASSERT_EQ(client.depth.start(), openni::STATUS_OK) << openni_error();
  ASSERT_EQ(client.color.start(), openni::STATUS_OK) << openni_error();
  ASSERT_TRUE(read(client.depth) && read(client.color));
  fake_usb::unplug("A");
  EXPECT_TRUE(events.wait_for("-" + uri_of("A")));
  client.device.close();
  EXPECT_EQ(fake_usb::usage("A").open_handles, 0);
  client.close();
}

TEST(HotPlug, ClosedBeforeItsStreamsAreDestroyed) {
  Rig const rig({kinect("A")});
  Client client("A");
  ASSERT_EQ(client.depth.start(), openni::STATUS_OK) << openni_error();
  ASSERT_TRUE(read(client.depth));
  client.depth.stop();
  client.device.close();
  EXPECT_EQ(fake_usb::usage("A").open_handles, 0);
  client.close();
  Client again("A");
  EXPECT_EQ(again.depth.start(), openni::STATUS_OK) << openni_error();
  EXPECT_TRUE(read(again.depth));
}

// libfreenect starts it without a word, and nothing ever comes.
TEST(HotPlug, UnpluggedWhileIdleAndThenStarted) {
  Rig const rig({kinect("A")});
  Events events;
  Client client("A");
  fake_usb::unplug("A");
  client.depth.start();
  EXPECT_TRUE(events.wait_for("-" + uri_of("A")));
  EXPECT_NE(client.color.start(), openni::STATUS_OK);
  EXPECT_THAT(openni_error(), HasSubstr("Kinect A was unplugged"));
  client.close();
  fake_usb::plug(kinect("A"));
  EXPECT_TRUE(events.wait_for("+" + uri_of("A")));
  Client again("A");
  EXPECT_EQ(again.depth.start(), openni::STATUS_OK) << openni_error();
  EXPECT_TRUE(read(again.depth));
}

TEST(HotPlug, TheOtherKinectGoesOn) {
  Rig const rig({kinect("A"), kinect("B")});
  Events events;
  Client first("A");
  Client second("B");
  first.depth.start();
  second.depth.start();
  ASSERT_TRUE(read(first.depth) && read(second.depth));
  fake_usb::unplug("A");
  EXPECT_TRUE(events.wait_for("-" + uri_of("A")));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(read(second.depth));
  }
}

/// A client that closes the device as it hears that it is gone.
class Closer : public openni::OpenNI::DeviceDisconnectedListener {
public:
  explicit Closer(Client& client) : client_(client) {
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }
  Closer(Closer const&) = delete;
  Closer& operator=(Closer const&) = delete;
  Closer(Closer&&) = delete;
  Closer& operator=(Closer&&) = delete;
  ~Closer() override { openni::OpenNI::removeDeviceDisconnectedListener(this); }
  void onDeviceDisconnected(openni::DeviceInfo const* /*info*/) override { client_.close(); }

private:
  Client& client_;
};

TEST(HotPlug, AClientMayCloseWhenItHears) {
  Rig const rig({kinect("A")});
  Client client("A");
  Events first;  // told after the closer, which OpenNI has at the end of its list
  Closer const closer(client);
  client.depth.start();
  ASSERT_TRUE(read(client.depth));
  fake_usb::unplug("A");
  EXPECT_TRUE(first.wait_for("-" + uri_of("A")));
  for (int i = 0; i < 200 && fake_usb::usage("A").open_handles > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(fake_usb::usage("A").open_handles, 0);
}

}  // namespace
}  // namespace credo::test
