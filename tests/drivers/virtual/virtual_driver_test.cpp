// A virtual sensor without faults, as a client of OpenNI2 sees it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drivers/virtual/virtual_client.hpp"

namespace credo::test {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> uris() {
  openni::Array<openni::DeviceInfo> list;
  openni::OpenNI::enumerateDevices(&list);
  std::vector<std::string> found;
  for (int i = 0; i < list.getSize(); ++i) {
    found.emplace_back(list[i].getUri());
  }
  return found;
}

TEST_F(VirtualDriver, PixelsStampsAndNumbersAreThoseOfTheDataset) {
  start_with_fault("");
  auto const all = received_until(40);
  for (Received const& image : all) {
    EXPECT_EQ(image.data, pixels_of(image)) << image.index;
    EXPECT_EQ(image.stamp_us, usual_stamp_us(image));
    EXPECT_EQ(image.bytes, static_cast<int>(image.data.size()));
  }
  EXPECT_GT(count(all, true, 0, 40), 5);
  EXPECT_GT(count(all, false, 0, 40), 5);
}

TEST_F(VirtualDriver, AnswersWhatClientsAsk) {
  start_with_fault("");
  Client client("a");
  EXPECT_STREQ(client.device().getDeviceInfo().getUri(), "virtual://a");
  openni::VideoMode const depth = client.depth().getVideoMode();
  EXPECT_EQ(depth.getPixelFormat(), openni::PIXEL_FORMAT_DEPTH_1_MM);
  EXPECT_EQ(depth.getResolutionX(), kWidth);
  EXPECT_EQ(depth.getResolutionY(), kHeight);
  EXPECT_EQ(depth.getFps(), 30);
  EXPECT_EQ(client.depth().setVideoMode(depth), openni::STATUS_OK);
  openni::VideoMode other = depth;
  other.setFps(60);
  EXPECT_NE(client.depth().setVideoMode(other), openni::STATUS_OK);
  EXPECT_EQ(client.color().getVideoMode().getPixelFormat(), openni::PIXEL_FORMAT_RGB888);
  EXPECT_NEAR(client.color().getVerticalFieldOfView(), 2 * std::atan(24.0 / kFocal_px), 1e-6);
  EXPECT_EQ(client.depth().getMinPixelValue(), 0);
  EXPECT_EQ(client.depth().getMaxPixelValue(), 10'000);
  int stride = 0;
  EXPECT_EQ(client.depth().getProperty(ONI_STREAM_PROPERTY_STRIDE, &stride), openni::STATUS_OK);
  EXPECT_EQ(stride, 2 * kWidth);
  EXPECT_EQ(client.color().getProperty(ONI_STREAM_PROPERTY_STRIDE, &stride), openni::STATUS_OK);
  EXPECT_EQ(stride, 3 * kWidth);
  EXPECT_FALSE(client.depth().getMirroringEnabled());
  EXPECT_TRUE(client.depth().isCroppingSupported());
  EXPECT_EQ(client.depth().getCameraSettings(), nullptr);
  EXPECT_EQ(client.device().setDepthColorSyncEnabled(true), openni::STATUS_OK);
  EXPECT_EQ(client.device().getSensorInfo(openni::SENSOR_IR), nullptr);
}

TEST_F(VirtualDriver, UnregisteredDepthIsWhatTheInfraredCameraSees) {
  start_with_fault("");
  Client client("a");
  EXPECT_EQ(client.device().getImageRegistrationMode(), openni::IMAGE_REGISTRATION_OFF);
  client.start();
  auto const all = client.receive_until(10);
  for (Received const& image : all) {
    EXPECT_EQ(image.data, image.is_depth ? bytes_of(literally_unregistered(depth_of(
                                               static_cast<std::size_t>(image.index) % kImages)))
                                         : pixels_of(image));
  }
  EXPECT_GT(count(all, true, 0, 11), 0);
}

TEST_F(VirtualDriver, TheFieldOfViewIsThatOfTheCameraWhoseImageItIs) {
  start_with_fault("");
  Client client("a");
  double const color_rad = 2.0 * std::atan(0.5 * kWidth / kFocal_px);
  double const infrared_rad = 2.0 * std::atan(0.5 * kWidth / (kFocal_px * 575.8 / 525.0));
  EXPECT_NEAR(client.depth().getHorizontalFieldOfView(), infrared_rad, 1e-6);
  EXPECT_NEAR(client.color().getHorizontalFieldOfView(), color_rad, 1e-6);
  client.register_depth();
  EXPECT_NEAR(client.depth().getHorizontalFieldOfView(), color_rad, 1e-6);
}

TEST_F(VirtualDriver, MirrorsAndCutsWhereAsked) {
  start_with_fault("");
  Client client("a");
  client.register_depth();
  EXPECT_EQ(client.depth().setMirroringEnabled(true), openni::STATUS_OK);
  EXPECT_TRUE(client.depth().getMirroringEnabled());
  EXPECT_EQ(client.color().setCropping(4, 5, 8, 6), openni::STATUS_OK);
  EXPECT_NE(client.color().setCropping(60, 0, 8, 6), openni::STATUS_OK);
  client.start();
  for (Received const& image : client.receive_until(10)) {
    std::size_t const shown = static_cast<std::size_t>(image.index) % kImages;
    if (image.is_depth) {
      Grid<std::uint16_t> mirrored = depth_of(shown);
      for (int v = 0; v < kHeight; ++v) {
        std::ranges::reverse(mirrored.row(v));
      }
      EXPECT_EQ(image.data, bytes_of(mirrored));
    } else {
      Grid<Rgb> cut(8, 6);
      for (int v = 0; v < 6; ++v) {
        for (int u = 0; u < 8; ++u) {
          cut[{u, v}] = color_of(shown)[{u + 4, v + 5}];
        }
      }
      EXPECT_EQ(image.width, 8);
      EXPECT_EQ(image.data, bytes_of(cut));
    }
  }
}

TEST_F(VirtualDriver, OnceMeansThatItEnds) {
  start_with_fault("", R"("play": "once", )");
  Client client("a");
  client.register_depth();
  client.start();
  auto const all = client.receive_until(1000, 1500);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.back().index, static_cast<int>(kImages) - 1);
}

TEST_F(VirtualDriver, SeveralSensorsOfOneScriptPlayAtOnce) {
  start_openni(R"({"sensors": [{"name": "a", "dataset": "a"}, {"name": "b", "dataset": "b"}]})");
  EXPECT_THAT(uris(), testing::UnorderedElementsAre("virtual://a", "virtual://b"));
  Client a("a");
  Client b("b");
  for (Client* client : {&a, &b}) {
    client->register_depth();
    client->start();
  }
  for (auto const& [client, images] : {std::pair(&a, kImages), std::pair(&b, std::size_t{1})}) {
    auto const all = client->receive_until(30);
    EXPECT_GT(count(all, true, 0, 31), 0);
    for (Received const& image : all) {
      EXPECT_EQ(image.data, pixels_of(image, images)) << image.index;
    }
  }
}

TEST_F(VirtualDriver, OpensAndClosesFiftyTimes) {
  start_with_fault("");
  int last = -1;
  for (int i = 0; i < 50; ++i) {
    Client client("a");
    ASSERT_EQ(client.status(), openni::STATUS_OK) << i;
    client.register_depth();
    client.start();
    auto const all = client.receive_until(last + 1);
    ASSERT_FALSE(all.empty()) << i;
    EXPECT_EQ(all.back().data, pixels_of(all.back()));
    EXPECT_GE(all.back().index, last + 1) << "its time goes on";
    last = all.back().index;
    if (i % 2 == 0) {
      // As our own client does it. OpenNI2 itself crashes where they have not been stopped.
      client.depth().stop();
      client.color().stop();
      client.device().close();
    }
  }
}

TEST_F(VirtualDriver, StopsAndStartsAgain) {
  start_with_fault("");
  Client client("a");
  client.register_depth();
  client.start();
  int last = client.receive_until(3).back().index;
  for (int i = 0; i < 5; ++i) {
    client.depth().stop();
    client.color().stop();
    client.start();
    auto const all = client.receive_until(last + 3);
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.back().data, pixels_of(all.back()));
    last = all.back().index;
  }
}

TEST_F(VirtualDriver, SaysWhichSensorsThereAre) {
  start_with_fault("");
  EXPECT_THAT(error_of("virtual://c"),
              HasSubstr("virtual://c: is not plugged in; known are virtual://a. "));
}

TEST_F(VirtualDriver, SaysWhatIsWrongWithADataset) {
  start_openni(R"({"sensors": [{"name": "a", "dataset": "none"}]})");
  EXPECT_THAT(
      error_of("virtual://a"),
      HasSubstr("virtual://a: dataset " + (folder_ / "none").string() + ": no such folder. "));
}

// Who opens just any sensor is told by stderr, who names one by OpenNI2 as well.
TEST_F(VirtualDriver, AnUnreadableScriptIsTold) {
  testing::internal::CaptureStderr();
  start_openni(R"({"sensors": 1})");
  std::string const trouble = (folder_ / "s.json").string() + ": sensors: must be a list";
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "CREDO_VIRTUAL_SENSOR: " + trouble + "\n");
  EXPECT_THAT(error_of("virtual://a"), HasSubstr("virtual://a: " + trouble + ". "));
  EXPECT_THAT(uris(), testing::IsEmpty());
}

TEST_F(VirtualDriver, ARelativeScriptIsTold) {
  testing::internal::CaptureStderr();
  start_with("s.json");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "CREDO_VIRTUAL_SENSOR: s.json: must be an absolute path: OpenNI2 starts drivers in "
            "their own folder\n");
}

TEST_F(VirtualDriver, WithoutAScriptItIsSilent) {
  testing::internal::CaptureStderr();
  start_with("");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(uris(), testing::IsEmpty());
  EXPECT_THAT(error_of("virtual://a"),
              HasSubstr("virtual://a: CREDO_VIRTUAL_SENSOR names no script; see "
                        "docs/virtual-sensor.md. "));
}

}  // namespace
}  // namespace credo::test
