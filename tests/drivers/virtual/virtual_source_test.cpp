// Our own live source on a virtual sensor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include <string>
#include <variant>

#include "core/error.hpp"
#include "drivers/virtual/virtual_client.hpp"
#include "io/dataset.hpp"
#include "openni/openni_source.hpp"

namespace credo::test {
namespace {

class VirtualSource : public ::testing::Test {
protected:
  OpenedSource open_with(std::string const& fault) {
    write_dataset(folder_ / "a", 12);
    write_text(folder_ / "s.json",
               R"({"sensors": [{"name": "a", "dataset": "a", "faults": [)" + fault + "]}]}");
    ::setenv("CREDO_VIRTUAL_SENSOR", (folder_ / "s.json").c_str(), 1);
    return open_openni("virtual://a", {}, {}, {});
  }

  TempFolder folder_;
};

TEST_F(VirtualSource, SeesWhatTheDatasetHolds) {
  OpenedSource const live = open_with("");
  EXPECT_TRUE(live.warnings.empty());
  int colored = 0;
  for (int i = 0; i < 20; ++i) {
    auto const frame = std::get<FramePtr>(live.source->next());
    // The image is known by its first pixel.
    auto const image =
        static_cast<std::size_t>(std::lround((1000 * frame->cloud_camera.z[0] - 300) / 60));
    Grid<std::uint16_t> const expected = depth_of(image);
    for (std::size_t p = 1; p < expected.size(); ++p) {
      float const z_m = frame->cloud_camera.z[p];
      ASSERT_EQ(std::isnan(z_m) ? 0 : std::lround(1000 * z_m), expected[p]) << p;
    }
    colored += frame->color == color_of(image) ? 1 : 0;
    EXPECT_NEAR(frame->intrinsics.fx_px, kFocal_px, 1e-4);
  }
  EXPECT_GT(colored, 0);
}

TEST_F(VirtualSource, AStallIsAFailureAndThenItGoesOn) {
  OpenedSource const live = open_with(R"({"fault": "stall", "at_frame": 10, "for_s": 3})");
  bool stalled = false;
  for (int after = 0; after < 3;) {
    SourceResult const result = live.source->next();
    if (auto const* failure = std::get_if<FrameFailure>(&result)) {
      EXPECT_EQ(failure->reason, "stalled");
      stalled = true;
    } else {
      after += stalled ? 1 : 0;
    }
  }
}

TEST_F(VirtualSource, AnUnpluggedSensorIsAnError) {
  OpenedSource const live = open_with(R"({"fault": "unplug", "at_frame": 10})");
  try {
    for (int i = 0; i < 1000; ++i) {
      static_cast<void>(live.source->next());
    }
    FAIL();
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "openni:virtual://a: was unplugged");
  }
}

// Frames of another size fail to be frames; those that come again are taken.
TEST_F(VirtualSource, ImagesOfAWrongSizeAreNotTaken) {
  OpenedSource const live = open_with(
      R"({"fault": "corrupt", "how": "size", "at_frame": 10, "for_frames": 20, "stream": "depth"})");
  bool after = false;
  while (!after) {
    auto const frame = std::get<FramePtr>(live.source->next());
    auto const tick = (frame->stamp_ns / 1'000'000 - 1000) * 30 / 1000 + 1;
    EXPECT_TRUE(tick <= 11 || tick >= 30) << tick;
    after = tick >= 30;
  }
}

}  // namespace
}  // namespace credo::test
