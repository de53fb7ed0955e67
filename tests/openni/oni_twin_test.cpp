// Our reading of recordings beside OpenNI2's own player.
#include <OpenNI.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <variant>
#include <vector>

#include "openni/oni_source.hpp"
#include "openni/sensor_image.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;

/// What OpenNI2's own player makes of a recording: the slow twin, which loses what is damaged.
struct Played {
  std::vector<std::vector<std::uint16_t>> depth;
  std::vector<std::vector<Rgb>> color;
};

Played played_by_openni(fs::path const& path) {
  Played played;
  openni::OpenNI::initialize();
  {
    openni::Device device;
    EXPECT_EQ(device.open(path.c_str()), openni::STATUS_OK);
    device.getPlaybackControl()->setSpeed(-1);  // waits for whoever reads
    device.getPlaybackControl()->setRepeatEnabled(false);
    openni::VideoStream depth;
    openni::VideoStream color;
    depth.create(device, openni::SENSOR_DEPTH);
    color.create(device, openni::SENSOR_COLOR);
    depth.start();
    color.start();
    std::array<openni::VideoStream*, 2> streams = {&depth, &color};
    int ready = 0;
    while (openni::OpenNI::waitForAnyStream(streams.data(), 2, &ready, 1000) == openni::STATUS_OK) {
      openni::VideoFrameRef frame;
      streams.at(static_cast<std::size_t>(ready))->readFrame(&frame);
      auto const bytes = static_cast<std::size_t>(frame.getDataSize());
      if (ready == 0) {
        std::memcpy(played.depth.emplace_back(bytes / 2).data(), frame.getData(), bytes);
      } else {
        std::memcpy(played.color.emplace_back(bytes / 3).data(), frame.getData(), bytes);
      }
    }
  }
  openni::OpenNI::shutdown();
  return played;
}

// A real recording of a Kinect, mirrored, depth packed as 16zT and colour as JPEG.
TEST(OniTwin, EqualsOpennisPlayerOnTheLivingRoom) {
  CREDO_REQUIRE_RECORDING("oni/living-room.oni");
  fs::path const path = recordings() / "oni/living-room.oni";
  Played const played = played_by_openni(path);
  OpenedSource const opened = open_oni(path, {}, {});
  EXPECT_EQ(opened.frame_count, 12U);
  ASSERT_EQ(played.depth.size(), 12U);
  ASSERT_EQ(played.color.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    auto const frame = std::get<FramePtr>(opened.source->next());
    ASSERT_EQ(frame->cloud_camera.width(), 640);
    Grid<float> depth_m = depth_image(played.depth[i], 640, 480, {});
    mirror(depth_m);
    Grid<Rgb> color(640, 480, played.color[i]);
    mirror(color);
    EXPECT_TRUE(frame->color == color) << i;
    int unlike = 0;
    for (std::size_t p = 0; p < depth_m.size(); ++p) {
      float const z = frame->cloud_camera.z[p];
      unlike += (depth_m[p] > 0 ? z != depth_m[p] : !std::isnan(z)) ? 1 : 0;
    }
    EXPECT_EQ(unlike, 0) << i;
  }
}

}  // namespace
}  // namespace credo::test
