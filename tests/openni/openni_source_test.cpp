// The live path, with OpenNI2 playing recordings in the place of a sensor.
#include "openni/openni_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "openni/oni_source.hpp"
#include "support/oni_writer.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

using ::testing::HasSubstr;

OniScript slanted(int frames) {
  OniScript script;
  script.width = 64;
  script.height = 48;
  script.mirrored = true;
  for (int i = 0; i < frames; ++i) {
    std::vector<std::uint16_t> counts;
    std::string color;
    for (int p = 0; p < 64 * 48; ++p) {
      counts.push_back(static_cast<std::uint16_t>(1000 + p + i));
      color += {static_cast<char>(p), static_cast<char>(i), static_cast<char>(p / 64)};
    }
    script.depth_images.push_back(packed(counts));
    script.color_images.push_back(color);
  }
  return script;
}

class OpenniSource : public ::testing::Test {
protected:
  std::string recorded(OniScript const& script) {
    write_text(folder_ / "a.oni", oni_bytes(script));
    return (folder_ / "a.oni").string();
  }

  TempFolder folder_;
};

// What comes through OpenNI2 is what we read ourselves, turned back from its mirroring as well.
TEST_F(OpenniSource, EqualsTheRecording) {
  std::string const path = recorded(slanted(10));
  OpenedSource const ours = open_oni(path, {}, {});
  std::vector<FramePtr> expected;
  for (SourceResult result = ours.source->next(); std::holds_alternative<FramePtr>(result);
       result = ours.source->next()) {
    expected.push_back(std::get<FramePtr>(result));
  }
  OpenedSource const opened = open_openni(path, {}, {}, {}, {}, {});
  EXPECT_FALSE(opened.frame_count.has_value());
  std::int64_t frames = 0;
  int colored = 0;
  for (SourceResult result = opened.source->next(); !std::holds_alternative<EndOfSource>(result);
       result = opened.source->next(), ++frames) {
    auto const frame = std::get<FramePtr>(result);
    EXPECT_EQ(number(frame->index), frames);
    // In real time: one that was slow to be taken may have been replaced.
    auto const twin = std::ranges::find(expected, frame->stamp_ns, &Frame::stamp_ns);
    ASSERT_NE(twin, expected.end()) << frame->stamp_ns;
    EXPECT_NEAR(frame->intrinsics.fx_px, (*twin)->intrinsics.fx_px, 1e-4) << "float and double";
    for (std::size_t i = 0; i < frame->cloud_camera.size(); ++i) {
      ASSERT_EQ(frame->cloud_camera.z[i], (*twin)->cloud_camera.z[i]);
    }
    colored += frame->color == (*twin)->color ? 1 : 0;
  }
  EXPECT_GT(colored, 0) << "colour may come after its depth";
  EXPECT_GT(frames, 0);
}

TEST_F(OpenniSource, WithoutASensorItSaysSo) {
  std::string const missing = (folder_ / "none.oni").string();
  try {
    open_openni(missing, {}, {}, {}, {}, {});
    FAIL();
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(), HasSubstr("openni:" + missing + ": no such sensor: "));
  }
  PoseConfig pose;
  pose.source = PoseSource::kFile;
  EXPECT_THROW(open_openni(missing, {}, pose, {}, {}, {}), InputError);
}

// A recording without its end record never ends for OpenNI2: as silent as a sensor that hangs.
TEST_F(OpenniSource, SilenceIsAFailureAndStopsOnRequest) {
  std::string bytes = oni_bytes(slanted(2));
  bytes.resize(bytes.size() - 28);
  write_text(folder_ / "a.oni", bytes);
  std::stop_source stop;
  OpenedSource const opened =
      open_openni((folder_ / "a.oni").string(), {}, {}, {}, {}, stop.get_token());
  SourceResult result = opened.source->next();
  while (std::holds_alternative<FramePtr>(result)) {
    result = opened.source->next();
  }
  auto const& failure = std::get<FrameFailure>(result);
  EXPECT_EQ(failure.reason, "stalled");
  EXPECT_EQ(failure.loss, Loss::kSilence);
  EXPECT_THAT(failure.message, HasSubstr("sends no depth"));
  stop.request_stop();
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(opened.source->next()));
}

}  // namespace
}  // namespace credo::test
