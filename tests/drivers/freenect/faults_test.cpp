// What goes wrong with a Kinect costs what it must, is counted, and the run goes on. Unplugging:
// see hot_plug_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "drivers/freenect/kinect.hpp"
#include "drivers/freenect/properties.hpp"
#include "drivers/freenect/rig.hpp"

namespace credo::test {
namespace {

using fake_usb::Stream;
using freenect::kDroppedFramesProperty;
using freenect::kLostPacketsProperty;
using freenect::kStallsProperty;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

/// Reads until the stream has counted so much of something; the stamps must go up.
void read_until(openni::VideoStream& stream, int id, int count) {
  std::uint64_t last_us = 0;
  auto const deadline = Clock::now() + kPatience;
  while (property(stream, id) < count && Clock::now() < deadline) {
    if (std::optional<Image> const image = read(stream, std::chrono::milliseconds(100))) {
      EXPECT_GT(image->stamp_us, last_us);
      last_us = image->stamp_us;
    }
  }
  EXPECT_EQ(property(stream, id), count);
}

struct Loss {
  Stream stream;
  int packets;
  int dropped;
};

class Losses : public ::testing::TestWithParam<Loss> {};

// Up to 5: a frame with pixels of the one before. More: no frame.
TEST_P(Losses, LostPacketsAreCountedAndTheRunGoesOn) {
  Loss const loss = GetParam();
  Rig const rig({kinect("A")});
  Client client("A");
  client.depth.start();
  client.color.start();
  bool const of_depth = loss.stream == Stream::kDepth;
  openni::VideoStream& stream = of_depth ? client.depth : client.color;
  openni::VideoStream& other = of_depth ? client.color : client.depth;
  // libfreenect tells of no loss in the first two frames.
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(read(stream));
  }
  fake_usb::lose_packets("A", loss.stream, loss.packets);
  read_until(stream, kLostPacketsProperty, loss.packets);
  read_until(stream, kDroppedFramesProperty, loss.dropped);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(read(stream));
    ASSERT_TRUE(read(other));
  }
  EXPECT_EQ(property(stream, kLostPacketsProperty), loss.packets);
  EXPECT_EQ(property(stream, kDroppedFramesProperty), loss.dropped);
  EXPECT_EQ(property(other, kLostPacketsProperty), 0);
  EXPECT_EQ(property(stream, kStallsProperty), 0);
}

INSTANTIATE_TEST_SUITE_P(Streams, Losses,
                         ::testing::Values(Loss{Stream::kDepth, 1, 0}, Loss{Stream::kDepth, 5, 0},
                                           Loss{Stream::kColor, 3, 0}, Loss{Stream::kDepth, 6, 1},
                                           Loss{Stream::kDepth, 60, 1},
                                           Loss{Stream::kColor, 20, 1}));

class Stalls : public ::testing::TestWithParam<Stream> {};

TEST_P(Stalls, ASilentStreamIsStartedAnew) {
  Rig const rig({kinect("A")});
  Client client("A");
  client.depth.start();
  client.color.start();
  bool const of_depth = GetParam() == Stream::kDepth;
  openni::VideoStream& silent = of_depth ? client.depth : client.color;
  openni::VideoStream& other = of_depth ? client.color : client.depth;
  ASSERT_TRUE(read(silent));
  EXPECT_EQ(client.color.getCameraSettings()->setAutoExposureEnabled(false), openni::STATUS_OK);
  std::uint16_t const flags = fake_usb::usage("A").color_flags;
  fake_usb::stall("A", GetParam());
  auto const deadline = Clock::now() + kPatience;
  while (property(silent, kStallsProperty) == 0 && Clock::now() < deadline) {
    ASSERT_TRUE(read(other)) << "the other one goes on";
  }
  // What had come before is past once OpenNI has handed it out.
  std::optional<Image> const before = read(silent);
  std::optional<Image> const after = read(silent);
  ASSERT_TRUE(before && after);
  EXPECT_GT(after->stamp_us, before->stamp_us);
  EXPECT_EQ(property(silent, kStallsProperty), 1);
  EXPECT_EQ(property(other, kStallsProperty), 0);
  EXPECT_EQ(fake_usb::usage("A").depth_starts, of_depth ? 2 : 1);
  EXPECT_EQ(fake_usb::usage("A").color_starts, of_depth ? 1 : 2);
  EXPECT_EQ(fake_usb::usage("A").color_flags, flags) << "as it was set";
}

INSTANTIATE_TEST_SUITE_P(Streams, Stalls, ::testing::Values(Stream::kDepth, Stream::kColor));

// libfreenect says that the stream has started.
TEST(Faults, RefusedTransfersAreTriedAgain) {
  Rig const rig({kinect("A")});
  Client client("A");
  fake_usb::set_faults("A", {.submit_error = -1});
  EXPECT_EQ(client.depth.start(), openni::STATUS_OK);
  EXPECT_FALSE(read(client.depth, std::chrono::milliseconds(300)));
  read_until(client.depth, kStallsProperty, 1);
  fake_usb::set_faults("A", {});
  EXPECT_TRUE(read(client.depth));
}

TEST(Faults, AKinectThatIsSilentAtOpeningIsGivenUp) {
  Rig const rig({kinect("A"), kinect("B")});
  fake_usb::set_faults("A", {.silent_replies = true});
  openni::Device device;
  auto const begin = Clock::now();
  EXPECT_NE(device.open(uri_of("A").c_str()), openni::STATUS_OK);
  EXPECT_LT(Clock::now() - begin, kPatience);
  EXPECT_THAT(openni_error(), HasSubstr("Kinect A does not answer"));
  Client other("B");
  other.depth.start();
  EXPECT_TRUE(read(other.depth));
  // Its thread comes back, and closes what it had opened.
  fake_usb::set_faults("A", {});
  auto const deadline = Clock::now() + kPatience;
  while (fake_usb::usage("A").open_handles > 0 && Clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  Client again("A");
  again.depth.start();
  EXPECT_TRUE(read(again.depth));
}

TEST(Faults, AKinectThatFallsSilentIsGivenUpAndReported) {
  Rig const rig({kinect("A")});
  Events events;
  Client client("A");
  client.depth.start();
  ASSERT_TRUE(read(client.depth));
  fake_usb::set_faults("A", {.silent_replies = true});
  EXPECT_NE(client.color.start(), openni::STATUS_OK);
  EXPECT_THAT(openni_error(), HasSubstr("Kinect A does not answer"));
  EXPECT_TRUE(events.wait_for("-" + uri_of("A")));
  EXPECT_NE(client.color.start(), openni::STATUS_OK);
  EXPECT_THAT(openni_error(), HasSubstr("Kinect A was unplugged, or given up")) << "not asked";
  auto const begin = Clock::now();
  client.close();
  EXPECT_LT(Clock::now() - begin, kPatience);
}

TEST(Faults, BusyIsSaid) {
  Rig const rig({kinect("A")});
  fake_usb::set_faults("A", {.claim_error = -6});
  openni::Device device;
  EXPECT_NE(device.open(uri_of("A").c_str()), openni::STATUS_OK);
  EXPECT_THAT(openni_error(), HasSubstr("Kinect A does not open: is it in use"));
  EXPECT_THAT(openni_error(), HasSubstr("LIBUSB_ERROR_BUSY"));
  fake_usb::set_faults("A", {});
  EXPECT_EQ(device.open(uri_of("A").c_str()), openni::STATUS_OK);
}

TEST(Faults, NoPermissionIsSaidAndTheKinectIsThereOnceItIsGiven) {
  fake_usb::plug(kinect("A"));
  fake_usb::set_faults("A", {.open_error = -3});
  Rig const rig({});
  Events events;
  openni::Array<openni::DeviceInfo> list;
  openni::OpenNI::enumerateDevices(&list);
  EXPECT_EQ(list.getSize(), 0);
  openni::Device device;
  EXPECT_NE(device.open(uri_of("A").c_str()), openni::STATUS_OK);
  EXPECT_THAT(openni_error(), HasSubstr("1 Kinect(s) plugged in may not be read"));
  fake_usb::set_faults("A", {});
  EXPECT_TRUE(events.wait_for("+" + uri_of("A")));
  EXPECT_EQ(device.open(uri_of("A").c_str()), openni::STATUS_OK) << openni_error();
  device.close();
  fake_usb::unplug("A");
}

// libfreenect opens by the place on the bus, of which its list leaves out the unreadable one.
TEST(Faults, NoKinectIsTakenForAnother) {
  fake_usb::plug(kinect("A"));
  fake_usb::set_faults("A", {.open_error = -3});
  Rig const rig({kinect("B")});
  openni::Device device;
  EXPECT_NE(device.open(uri_of("B").c_str()), openni::STATUS_OK);
  EXPECT_THAT(openni_error(), HasSubstr("Kinect B may be mistaken for another"));
  fake_usb::unplug("A");
  EXPECT_EQ(device.open(uri_of("B").c_str()), openni::STATUS_OK) << openni_error();
}

// libfreenect's own close would stop depth only. Below OpenNI2, which may crash by itself where a
// program closes a device whose streams run.
TEST(Faults, ClosingStopsBothStreams) {
  fake_usb::plug(kinect("A"));
  std::atomic<int> depths = 0;
  std::atomic<int> colors = 0;
  {
    freenect::Kinect open("A", {[&](auto, auto const&, auto) { ++depths; },
                                [&](auto, auto) { ++colors; }, [](std::string const&) {}});
    open.start(freenect::StreamKind::kDepth);
    open.start(freenect::StreamKind::kColor);
    auto const deadline = Clock::now() + kPatience;
    while ((depths == 0 || colors == 0) && Clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_GT(fake_usb::usage("A").transfers_in_flight, 16) << "of both";
  }
  EXPECT_GT(depths, 0);
  EXPECT_GT(colors, 0);
  EXPECT_EQ(fake_usb::usage("A").transfers_in_flight, 0);
  EXPECT_EQ(fake_usb::usage("A").open_handles, 0);
  EXPECT_EQ(fake_usb::usage("A").misuses, 0);
  fake_usb::unplug("A");
}

// No look at the bus is needed for that.
TEST(Faults, AStreamTellsOfUnplugging) {
  fake_usb::plug(kinect("A"));
  std::atomic<bool> told = false;
  freenect::Kinect open("A", {[](auto, auto const&, auto) {}, [](auto, auto) {},
                              [&](std::string const& line) { told = line == "was unplugged"; }});
  open.start(freenect::StreamKind::kDepth);
  EXPECT_FALSE(open.lost());
  fake_usb::unplug("A");
  auto const deadline = Clock::now() + kPatience;
  while (!told && Clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(told);
  EXPECT_TRUE(open.lost());
}

// Frames of both streams are there at once; whoever hears of the first ends it all.
TEST(Faults, NothingIsToldFromTheEndOn) {
  fake_usb::plug(kinect("A"));
  std::optional<freenect::KinectThread> thread;
  int told = 0;
  auto const tell = [&] {
    ++told;
    thread->end();
  };
  thread.emplace("A", freenect::KinectSinks{[&](auto, auto const&, auto) { tell(); },
                                            [&](auto, auto) { tell(); }, [](auto const&) {}});
  thread->ask([&](freenect::OpenKinect& open) {
    thread->start(open, freenect::StreamKind::kDepth);
    thread->start(open, freenect::StreamKind::kColor);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  });
  thread->run();
  EXPECT_EQ(told, 1);
  EXPECT_EQ(fake_usb::usage("A").open_handles, 0);
  EXPECT_EQ(fake_usb::usage("A").misuses, 0);
  fake_usb::unplug("A");
}

}  // namespace
}  // namespace credo::test
