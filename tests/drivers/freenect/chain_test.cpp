// What a Kinect sends comes out of OpenNI2, pixel by pixel: by libfreenect alone, on the same bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libfreenect.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "drivers/freenect/rig.hpp"

namespace credo::test {
namespace {

std::vector<std::uint16_t> cleaned(std::vector<std::uint16_t> depths_mm) {
  for (std::uint16_t& depth_mm : depths_mm) {
    if (depth_mm >= 10000 || depth_mm == 6351 || depth_mm == 3755) {
      depth_mm = 0;
    }
  }
  return depths_mm;
}

template <typename T>
std::vector<T> mirrored(std::vector<T> const& image, std::size_t values_a_pixel) {
  std::vector<T> turned(image.size());
  for (std::size_t p = 0; p < kPixels; ++p) {
    std::size_t const from = p / 640 * 640 + 639 - p % 640;
    for (std::size_t i = 0; i < values_a_pixel; ++i) {
      turned[p * values_a_pixel + i] = image[from * values_a_pixel + i];
    }
  }
  return turned;
}

/// All three images of each stream equal the plain ones.
void expect_images(Client& client, PlainImages const& plain, bool mirror) {
  std::set<std::size_t> depths;
  std::set<std::size_t> colors;
  for (int i = 0; i < 60 && (depths.size() < 3 || colors.size() < 3); ++i) {
    std::optional<Image> const depth = read(client.depth);
    std::optional<Image> const color = read(client.color);
    ASSERT_TRUE(depth && color);
    auto const expected_depth = cleaned(plain.depths_mm[image_at(depth->stamp_us)]);
    auto const& expected_color = plain.colors[image_at(color->stamp_us)];
    ASSERT_TRUE(depth->depths_mm() == (mirror ? mirrored(expected_depth, 1) : expected_depth)) << i;
    ASSERT_TRUE(color->bytes == (mirror ? mirrored(expected_color, 3) : expected_color)) << i;
    depths.insert(image_at(depth->stamp_us));
    colors.insert(image_at(color->stamp_us));
  }
  EXPECT_EQ(depths.size(), 3U);
  EXPECT_EQ(colors.size(), 3U);
}

double focal_length_px(openni::VideoStream const& stream) {
  return 320.0 / std::tan(0.5 * static_cast<double>(stream.getHorizontalFieldOfView()));
}

TEST(Chain, DepthAndColorAreWhatLibfreenectMakesOfThem) {
  Rig const rig({kinect("A")});
  PlainImages const plain = plain_images(FREENECT_DEPTH_MM);
  for (int const nonsense : {6351, 3755, 10000}) {
    EXPECT_NE(std::ranges::count(plain.depths_mm[0], nonsense), 0) << "or nothing is cleaned";
  }
  Client client("A");
  ASSERT_EQ(client.depth.start(), openni::STATUS_OK) << openni_error();
  ASSERT_EQ(client.color.start(), openni::STATUS_OK) << openni_error();
  expect_images(client, plain, false);
  EXPECT_NEAR(focal_length_px(client.depth), 575.8, 0.01);
  EXPECT_NEAR(focal_length_px(client.color), 525.0, 0.01);
  client.depth.setMirroringEnabled(true);
  client.color.setMirroringEnabled(true);
  // What was on its way is not mirrored.
  for (int i = 0; i < 3; ++i) {
    read(client.depth);
    read(client.color);
  }
  expect_images(client, plain, true);
}

TEST(Chain, RegisteredDepthIsWhatLibfreenectMakesOfIt) {
  Rig const rig({kinect("A")});
  PlainImages const plain = plain_images(FREENECT_DEPTH_REGISTERED);
  Client client("A");
  ASSERT_TRUE(
      client.device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
  ASSERT_EQ(client.device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR),
            openni::STATUS_OK);
  ASSERT_EQ(client.depth.start(), openni::STATUS_OK) << openni_error();
  ASSERT_EQ(client.color.start(), openni::STATUS_OK) << openni_error();
  expect_images(client, plain, false);
  EXPECT_NEAR(focal_length_px(client.depth), 525.0, 0.01);
}

/// Nothing but a pixel here and there.
fake_usb::Kinect dotted(std::vector<std::pair<int, int>> const& pixels, std::uint16_t raw) {
  fake_usb::Kinect one = kinect("A");
  std::vector<std::uint16_t> image(kPixels, 2047);
  for (auto const& [u, v] : pixels) {
    image[static_cast<std::size_t>(v * 640 + u)] = raw;
  }
  one.images.depth_raw = {image};
  return one;
}

// Registration may be switched while depth runs, and back.
TEST(Chain, RegisteredDepthLiesWhereTheColorCameraSeesIt) {
  constexpr std::uint16_t kRaw = 900;
  double const depth_mm = fake_usb::depth_mm(kRaw);
  std::vector<std::pair<int, int>> const pixels = {{100, 60}, {320, 240}, {600, 60}, {330, 440}};
  Rig const rig({dotted(pixels, kRaw)});
  Client client("A");
  ASSERT_EQ(client.depth.start(), openni::STATUS_OK) << openni_error();
  for (bool const registered : {false, true, false}) {
    client.device.setImageRegistrationMode(registered ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR
                                                      : openni::IMAGE_REGISTRATION_OFF);
    std::optional<Image> image = read(client.depth);
    image = read(client.depth);  // one may have been on its way
    image = read(client.depth);
    ASSERT_TRUE(image);
    auto const depths = image->depths_mm();
    EXPECT_EQ(kPixels - std::ranges::count(depths, 0), std::ssize(pixels));
    for (auto const& [u, v] : pixels) {
      double const expected_u = registered ? fake_usb::registered_u_px(u, depth_mm) : u;
      double const expected_v = registered ? fake_usb::registered_v_px(v) : v;
      int found = 0;
      for (int p = 0; p < kPixels; ++p) {
        bool const near =
            std::abs(p % 640 - expected_u) <= 1.0 && std::abs(p / 640 - expected_v) <= 1.0;
        found += near && depths[static_cast<std::size_t>(p)] == std::floor(depth_mm) ? 1 : 0;
      }
      EXPECT_EQ(found, 1) << u << " " << v << (registered ? " registered" : "");
    }
  }
}

TEST(Chain, OneClockForBothStreamsThroughItsWrap) {
  fake_usb::Kinect one = kinect("A");
  one.first_stamp = 0U - 60'000'000U;  // wraps after a second
  Rig const rig({one});
  Client client("A");
  client.depth.start();
  client.color.start();
  std::uint64_t last_us = 0;
  // Until well beyond the wrap.
  for (std::uint64_t first_us = 0; first_us == 0 || last_us < first_us + 1'500'000;) {
    std::optional<Image> const depth = read(client.depth);
    std::optional<Image> const color = read(client.color);
    ASSERT_TRUE(depth && color);
    EXPECT_GT(depth->stamp_us, last_us);
    EXPECT_LT(depth->stamp_us, first_us + 3'000'000 + (first_us == 0 ? 1'000'000'000 : 0));
    // Frames are a third of 0.1 s apart, and colour comes 0.5 ms after its depth.
    EXPECT_NEAR(std::remainder(static_cast<double>(color->stamp_us - depth->stamp_us), 1e5 / 3),
                500, 2);
    last_us = depth->stamp_us;
    first_us = first_us == 0 ? last_us : first_us;
  }
}

TEST(Chain, AFrameIsAThirtiethOfASecond) {
  Rig const rig({kinect("A")});
  Client client("A");
  client.depth.start();
  std::optional<Image> const first = read(client.depth);
  std::optional<Image> last;
  for (int i = 0; i < 30; ++i) {
    last = read(client.depth);
  }
  ASSERT_TRUE(first && last);
  // As many as OpenNI took in, though the client may have missed some.
  EXPECT_NEAR(static_cast<double>(last->stamp_us - first->stamp_us) / (last->index - first->index),
              1e6 / 30, 1);
}

TEST(Chain, TwoKinectsAtOnceEachWithItsOwn) {
  std::vector<fake_usb::Kinect> two = {kinect("A"), kinect("B")};
  two[1].images.depth_raw = {std::vector<std::uint16_t>(kPixels, 700)};
  Rig const rig(two);
  openni::Array<openni::DeviceInfo> list;
  openni::OpenNI::enumerateDevices(&list);
  ASSERT_EQ(list.getSize(), 2);
  Client first("A");
  Client second("B");
  for (Client* client : {&first, &second}) {
    ASSERT_EQ(client->depth.start(), openni::STATUS_OK) << openni_error();
    ASSERT_EQ(client->color.start(), openni::STATUS_OK) << openni_error();
  }
  auto const expected = static_cast<std::uint16_t>(fake_usb::depth_mm(700));
  for (int i = 0; i < 20; ++i) {
    std::optional<Image> const a = read(first.depth);
    std::optional<Image> const b = read(second.depth);
    ASSERT_TRUE(a && b && read(first.color) && read(second.color));
    ASSERT_EQ(std::ranges::count(b->depths_mm(), expected), kPixels);
    ASSERT_NE(std::ranges::count(a->depths_mm(), expected), kPixels);
  }
}

TEST(Chain, StartsAndStopsFiftyTimes) {
  fake_usb::Kinect fast = kinect("A");
  fast.rate_hz = 120;
  Rig const rig({fast});
  Client client("A");
  for (int i = 0; i < 50; ++i) {
    ASSERT_EQ(client.depth.start(), openni::STATUS_OK) << openni_error();
    ASSERT_EQ(client.color.start(), openni::STATUS_OK) << openni_error();
    ASSERT_TRUE(read(client.depth)) << i;
    ASSERT_TRUE(read(client.color)) << i;
    client.depth.stop();
    client.color.stop();
    ASSERT_EQ(fake_usb::usage("A").transfers_in_flight, 0) << i;
  }
  EXPECT_EQ(fake_usb::usage("A").depth_starts, 50);
  EXPECT_EQ(fake_usb::usage("A").misuses, 0);
}

TEST(Chain, OneModeAndItsRanges) {
  Rig const rig({kinect("A")});
  Client client("A");
  openni::VideoMode mode = client.depth.getVideoMode();
  EXPECT_EQ(client.depth.setVideoMode(mode), openni::STATUS_OK) << openni_error();
  mode.setResolution(320, 240);
  EXPECT_NE(client.depth.setVideoMode(mode), openni::STATUS_OK);
  EXPECT_NE(client.depth.setCropping(0, 0, 320, 240), openni::STATUS_OK);
  EXPECT_EQ(client.depth.resetCropping(), openni::STATUS_OK) << openni_error();
  EXPECT_EQ(client.depth.getMinPixelValue(), 0);
  EXPECT_EQ(client.depth.getMaxPixelValue(), 9999);
  EXPECT_EQ(client.color.getMaxPixelValue(), 255);
  double const half_rad = 0.5 * static_cast<double>(client.depth.getVerticalFieldOfView());
  EXPECT_NEAR(240 / std::tan(half_rad), 575.8, 0.01);
}

TEST(Chain, AutomaticExposureAndWhiteBalance) {
  constexpr std::uint16_t kExposure = 1U << 14;
  constexpr std::uint16_t kWhiteBalance = 1U << 1;
  Rig const rig({kinect("A")});
  Client client("A");
  openni::CameraSettings* const settings = client.color.getCameraSettings();
  ASSERT_NE(settings, nullptr);
  EXPECT_TRUE(settings->getAutoExposureEnabled());
  // Set beforehand, it waits for the start.
  EXPECT_EQ(settings->setAutoExposureEnabled(false), openni::STATUS_OK);
  EXPECT_EQ(fake_usb::usage("A").color_flags, kExposure | kWhiteBalance);
  client.color.start();
  EXPECT_EQ(fake_usb::usage("A").color_flags, kWhiteBalance);
  EXPECT_EQ(settings->setAutoWhiteBalanceEnabled(false), openni::STATUS_OK);
  EXPECT_EQ(settings->setAutoExposureEnabled(true), openni::STATUS_OK);
  EXPECT_EQ(fake_usb::usage("A").color_flags, kExposure);
  EXPECT_FALSE(settings->getAutoWhiteBalanceEnabled());
  EXPECT_TRUE(settings->getAutoExposureEnabled());
}

}  // namespace
}  // namespace credo::test
