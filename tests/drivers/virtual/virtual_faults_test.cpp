// Each fault of a script, as a client of OpenNI2 sees it. A loaded machine may cost the client
// images: what it gets must be as scripted, and something must come before, during and after.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include <string>
#include <vector>

#include "drivers/virtual/sensor_schedule.hpp"
#include "drivers/virtual/virtual_client.hpp"

namespace credo::test {
namespace {

TEST_F(VirtualDriver, StallsOfOneStream) {
  for (bool const depth : {true, false}) {
    start_with_fault(std::string(R"({"fault": "stall", "at_frame": 20, "for_frames": 30, )") +
                     R"("stream": ")" + (depth ? "depth" : "color") + "\"}");
    auto const all = received_until(80);
    EXPECT_GT(count(all, depth, 0, 20), 0);
    EXPECT_EQ(count(all, depth, 20, 50), 0);
    EXPECT_GT(count(all, depth, 50, 81), 0);
    EXPECT_GT(count(all, !depth, 20, 50), 0);
    openni::OpenNI::shutdown();
  }
}

TEST_F(VirtualDriver, StallsOfBothStreams) {
  start_with_fault(R"({"fault": "stall", "at_frame": 20, "for_frames": 30})");
  auto const all = received_until(80);
  for (bool const depth : {true, false}) {
    EXPECT_GT(count(all, depth, 0, 20), 0);
    EXPECT_EQ(count(all, depth, 20, 50), 0);
    EXPECT_GT(count(all, depth, 50, 81), 0);
  }
}

TEST_F(VirtualDriver, RegistrationThatIsIgnored) {
  start_with_fault(R"({"fault": "registration_ignored", "at_frame": 20, "for_frames": 30})");
  auto const all = received_until(80);
  EXPECT_GT(count(all, true, 0, 20), 0);
  EXPECT_GT(count(all, true, 20, 50), 0);
  EXPECT_GT(count(all, true, 50, 81), 0);
  for (Received const& image : all) {
    bool const displaced = image.is_depth && image.index >= 20 && image.index < 50;
    auto const depth = depth_of(static_cast<std::size_t>(image.index) % kImages);
    EXPECT_EQ(image.data, displaced ? bytes_of(literally_unregistered(depth)) : pixels_of(image))
        << image.index;
  }
}

TEST_F(VirtualDriver, RegistrationThatIsMissing) {
  start_with_fault(R"({"fault": "registration_missing"})");
  Client client("a");
  EXPECT_FALSE(
      client.device().isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
  EXPECT_TRUE(client.device().isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_OFF));
  EXPECT_NE(client.device().setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR),
            openni::STATUS_OK);
  EXPECT_EQ(client.device().getImageRegistrationMode(), openni::IMAGE_REGISTRATION_OFF);
}

TEST_F(VirtualDriver, ColorOfAnotherTime) {
  start_with_fault(R"({"fault": "color_shift", "by_ms": 12, "at_frame": 20, "for_frames": 30})");
  auto const all = received_until(80);
  EXPECT_GT(count(all, false, 20, 50), 0);
  EXPECT_GT(count(all, false, 50, 81), 0);
  for (Received const& image : all) {
    bool const shifted = !image.is_depth && image.index >= 20 && image.index < 50;
    EXPECT_EQ(image.stamp_us, usual_stamp_us(image) + (shifted ? 12'000 : 0)) << image.index;
  }
}

TEST_F(VirtualDriver, ColorOfAnotherRate) {
  start_with_fault("", R"("color_rate_hz": 20, )");
  auto const all = received_until(40);
  EXPECT_GT(count(all, false, 0, 40), 0);
  for (Received const& image : all) {
    if (!image.is_depth) {
      EXPECT_EQ(image.stamp_us, 1'000'000U + static_cast<unsigned>(image.index) * 50'000U);
      std::size_t const shown = static_cast<std::size_t>(std::lround(1.5 * image.index)) % kImages;
      EXPECT_EQ(image.data, bytes_of(color_of(shown))) << image.index;
    }
  }
}

TEST_F(VirtualDriver, ClocksThatJumpAndWrap) {
  start_with_fault(R"({"fault": "clock_jump", "at_frame": 20, "by_s": 100},
                      {"fault": "clock_jump", "at_frame": 40, "by_s": -100.5})");
  auto const jumped = received_until(60);
  EXPECT_GT(count(jumped, true, 20, 40), 0);
  EXPECT_GT(count(jumped, true, 40, 61), 0);
  for (Received const& image : jumped) {
    std::int64_t const by_us = image.index < 20 ? 0 : image.index < 40 ? 100'000'000 : -500'000;
    EXPECT_EQ(static_cast<std::int64_t>(image.stamp_us),
              static_cast<std::int64_t>(usual_stamp_us(image)) + by_us);
  }
  openni::OpenNI::shutdown();
  start_with_fault(R"({"fault": "clock_wrap", "at_frame": 30})");
  auto const wrapped = received_until(60);
  EXPECT_GT(count(wrapped, true, 0, 30), 0);
  EXPECT_GT(count(wrapped, true, 30, 61), 0);
  for (Received const& image : wrapped) {
    EXPECT_TRUE(image.index < 30 ? image.stamp_us > 70'000'000 : image.stamp_us <= 1'000'000)
        << image.index << " " << image.stamp_us;
  }
}

TEST_F(VirtualDriver, ImagesOfAWrongSize) {
  start_with_fault(R"({"fault": "corrupt", "how": "size", "at_frame": 20, "stream": "depth"})");
  auto const all = received_until(40);
  EXPECT_GT(count(all, true, 20, 41), 0);
  for (Received const& image : all) {
    bool const small = image.is_depth && image.index >= 20;
    EXPECT_EQ(image.width, small ? kWidth / 2 : kWidth) << image.index;
    EXPECT_EQ(image.height, small ? kHeight / 2 : kHeight) << image.index;
  }
}

TEST_F(VirtualDriver, ImagesCutShort) {
  start_with_fault(R"({"fault": "corrupt", "how": "short", "at_frame": 20, "stream": "color"})");
  auto const all = received_until(40);
  EXPECT_GT(count(all, false, 20, 41), 0);
  for (Received const& image : all) {
    int const whole = kWidth * kHeight * (image.is_depth ? 2 : 3);
    EXPECT_EQ(image.bytes, !image.is_depth && image.index >= 20 ? whole / 2 : whole);
    EXPECT_EQ(image.width, kWidth);
  }
}

TEST_F(VirtualDriver, ImagesOfGarbage) {
  std::string const fault = R"({"fault": "corrupt", "how": "garbage", "at_frame": 10, "seed": 3})";
  std::map<std::pair<bool, int>, std::vector<unsigned char>> first;
  for (int run = 0; run < 2; ++run) {
    start_with_fault(fault);
    auto const all = received_until(30);
    EXPECT_GT(count(all, true, 10, 31), 0);
    EXPECT_GT(count(all, false, 10, 31), 0);
    for (Received const& image : all) {
      if (image.index < 10) {
        EXPECT_EQ(image.data, pixels_of(image));
        continue;
      }
      EXPECT_NE(image.data, pixels_of(image));
      auto const [seen, inserted] = first.try_emplace({image.is_depth, image.index}, image.data);
      EXPECT_EQ(seen->second, image.data) << "the same in each run";
    }
    openni::OpenNI::shutdown();
  }
}

TEST_F(VirtualDriver, HalfTheRate) {
  start_with_fault(R"({"fault": "rate", "every": 2, "at_frame": 20})");
  auto const all = received_until(60);
  EXPECT_GT(count(all, true, 20, 61), 3);
  for (Received const& image : all) {
    EXPECT_TRUE(image.index < 20 || image.index % 2 == 0) << image.index;
  }
}

TEST_F(VirtualDriver, ImagesDroppedAtRandom) {
  start_with_fault(R"({"fault": "drop", "share": 0.5, "seed": 1, "stream": "depth"})");
  auto const all = received_until(90);
  int const depth = count(all, true, 0, 90);
  EXPECT_GT(depth, 0);
  EXPECT_LT(depth, 60) << "of 45 on average";
  EXPECT_GT(count(all, false, 0, 90), 0);
  // Which, the schedule alone decides.
  SensorScript script;
  script.faults = {{.kind = FaultKind::kDrop, .color = false, .share = 0.5, .seed = 1}};
  SensorSchedule const schedule(script, kImages);
  for (Received const& image : all) {
    EXPECT_TRUE(
        schedule.at(image.is_depth ? SensorStream::kDepth : SensorStream::kColor, image.index))
        << image.index;
  }
}

TEST_F(VirtualDriver, TheFirstImageAfterAWhile) {
  start_with_fault(R"({"fault": "slow_start", "delay_s": 1})");
  Client client("a");
  client.register_depth();
  client.start();
  auto const first = client.receive_until(0);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_GE(first[0].index, 30);
  client.depth().stop();
  client.color().stop();
  client.start();
  auto const again = client.receive_until(0);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_GE(again[0].index, first[0].index + 30) << "after each start";
}

void expect_settings(openni::CameraSettings& settings, bool automatic, int exposure, int gain) {
  EXPECT_EQ(settings.getAutoExposureEnabled(), automatic);
  EXPECT_EQ(settings.getAutoWhiteBalanceEnabled(), automatic);
  EXPECT_EQ(settings.getExposure(), exposure);
  EXPECT_EQ(settings.getGain(), gain);
}

void set_all(openni::CameraSettings& settings) {
  EXPECT_EQ(settings.setAutoExposureEnabled(false), openni::STATUS_OK);
  EXPECT_EQ(settings.setAutoWhiteBalanceEnabled(false), openni::STATUS_OK);
  EXPECT_EQ(settings.setExposure(7), openni::STATUS_OK);
  EXPECT_EQ(settings.setGain(9), openni::STATUS_OK);
}

TEST_F(VirtualDriver, SettingsThatAStartKeeps) {
  start_with_fault("");
  Client client("a");
  openni::CameraSettings* const settings = client.color().getCameraSettings();
  ASSERT_NE(settings, nullptr);
  expect_settings(*settings, true, 100, 100);
  set_all(*settings);
  client.start();
  expect_settings(*settings, false, 7, 9);
}

TEST_F(VirtualDriver, SettingsThatAStartForgets) {
  start_with_fault(R"({"fault": "forget_settings"})");
  Client client("a");
  openni::CameraSettings* const settings = client.color().getCameraSettings();
  ASSERT_NE(settings, nullptr);
  set_all(*settings);
  expect_settings(*settings, false, 7, 9);
  client.start();
  expect_settings(*settings, true, 100, 100);
  set_all(*settings);
  expect_settings(*settings, false, 7, 9);
}

}  // namespace
}  // namespace credo::test
