#include "openni/registration_check.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>

#include "core/cloud.hpp"
#include "io/dataset.hpp"
#include "openni/oni_source.hpp"
#include "support/recordings.hpp"
#include "support/sensor_views.hpp"
#include "tools/scene_file.hpp"

namespace credo {
namespace {

/// Long enough for the check to look at six frames.
constexpr int kFrames = 30;
constexpr int kFramesPerLook = 5;

struct Case {
  char const* scene;
  SensorModel model;
};

class RegistrationOfScenes : public testing::TestWithParam<Case> {};

TEST_P(RegistrationOfScenes, IsFoundWithinThirtyFrames) {
  RegistrationCheck delivered_registered;
  RegistrationCheck delivered_raw;
  RegistrationCheck registered_here;
  Registration raw = Registration::kUndecided;
  Registration registered = Registration::kUndecided;
  Registration here = Registration::kUndecided;
  Scene const scene = load_scene(GetParam().scene);
  for (int i = 0; i < kFrames; i += kFramesPerLook) {
    auto const views = test::sensor_views(scene, GetParam().model, i / 30.0);
    Grid<float> const software_m = register_depth(views.depth_m, kinect_calibration(), 640, 480);
    for (int k = 0; k < kFramesPerLook; ++k) {
      registered = delivered_registered.add(views.registered_m, views.color);
      raw = delivered_raw.add(views.depth_m, views.color);
      here = registered_here.add(software_m, views.color);
    }
  }
  EXPECT_EQ(registered, Registration::kRegistered);
  EXPECT_EQ(raw, Registration::kUnregistered);
  EXPECT_EQ(here, Registration::kRegistered);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RegistrationOfScenes,
                         testing::Values(Case{"cluttered-table", SensorModel::kDisparity},
                                         Case{"cluttered-table", SensorModel::kGaussian},
                                         Case{"first-light", SensorModel::kDisparity},
                                         Case{"room-of-200", SensorModel::kGaussian}));

Registration after(Grid<float> const& depth_m, Grid<Rgb> const& color, int frames) {
  RegistrationCheck check;
  Registration result = Registration::kUndecided;
  for (int i = 0; i < frames; ++i) {
    result = check.add(depth_m, color);
  }
  return result;
}

Grid<Rgb> noise(unsigned seed) {
  std::mt19937 engine(seed);
  Grid<Rgb> color(640, 480);
  for (Rgb& pixel : color) {
    for (std::uint8_t& channel : pixel) {
      channel = static_cast<std::uint8_t>(engine() % 256);
    }
  }
  return color;
}

Grid<Rgb> checkered(int square_px) {
  Grid<Rgb> color(640, 480);
  for (std::size_t i = 0; i < color.size(); ++i) {
    Pixel const p = color.pixel(i);
    color[i] = (p.u / square_px + p.v / square_px) % 2 == 0 ? Rgb{230, 230, 230} : Rgb{30, 30, 30};
  }
  return color;
}

// The same two images again and again are not more evidence.
TEST(RegistrationCheck, StaysUndecidedWhereColourHasNothingToDoWithDepth) {
  auto const views =
      test::sensor_views(load_scene("cluttered-table"), SensorModel::kDisparity, 0.0);
  Grid<Rgb> upside_down = views.color;
  std::ranges::reverse(upside_down);
  for (Grid<float> const& depth_m : {views.depth_m, views.registered_m}) {
    EXPECT_EQ(after(depth_m, Grid<Rgb>(640, 480, Rgb{120, 130, 90}), 60), Registration::kUndecided);
    EXPECT_EQ(after(depth_m, upside_down, 60), Registration::kUndecided);
    for (unsigned const seed : {1U, 2U, 3U}) {
      EXPECT_EQ(after(depth_m, noise(seed), 60), Registration::kUndecided);
    }
    for (int const square_px : {5, 11, 20, 37, 64}) {
      EXPECT_EQ(after(depth_m, checkered(square_px), 60), Registration::kUndecided) << square_px;
    }
  }
}

TEST(RegistrationCheck, StaysUndecidedWhereDepthHasNoEdges) {
  auto const views = test::sensor_views(load_scene("wall-and-floor"), SensorModel::kIdeal, 0.0);
  EXPECT_EQ(after(views.depth_m, checkered(20), 100), Registration::kUndecided);
  RegistrationCheck check;
  check.add(views.depth_m, checkered(20));
  EXPECT_EQ(check.evidence().parts, 0);
}

// Depth that is off in a way that no calibration tells of.
TEST(RegistrationCheck, StaysUndecidedWhereDepthIsElsewhere) {
  auto const views =
      test::sensor_views(load_scene("cluttered-table"), SensorModel::kDisparity, 0.0);
  Grid<float> shifted_m(640, 480, 0.0F);
  for (int v = 40; v < 480; ++v) {
    std::ranges::copy(views.registered_m.row(v - 40), shifted_m.row(v).begin());
  }
  EXPECT_EQ(after(shifted_m, views.color, 100), Registration::kUndecided);
}

TEST(RegistrationCheck, OfNothingSaysNothing) {
  EXPECT_EQ(after({}, {}, 10), Registration::kUndecided);
  EXPECT_EQ(after(Grid<float>(640, 480, 1.0F), {}, 10), Registration::kUndecided);
  EXPECT_EQ(after(Grid<float>(640, 480, 1.0F), Grid<Rgb>(320, 240), 10), Registration::kUndecided);
  EXPECT_EQ(after(Grid<float>(1, 1, 1.0F), Grid<Rgb>(1, 1), 10), Registration::kUndecided);
  for (float const none : {0.0F, -1.0F, kNaN}) {
    EXPECT_EQ(after(Grid<float>(640, 480, none), noise(1), 10), Registration::kUndecided);
  }
}

TEST(RegistrationCheck, KeepsItsDecision) {
  auto const views = test::sensor_views(load_scene("first-light"), SensorModel::kIdeal, 0.0);
  RegistrationCheck check;
  ASSERT_EQ(check.add(views.registered_m, views.color), Registration::kRegistered);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(check.add(views.depth_m, views.color), Registration::kRegistered);
  }
}

TEST(RegistrationCheck, RefusesACalibrationWithoutFocalLength) {
  DepthCalibration calibration = kinect_calibration();
  calibration.color.fx_px = 0.0;
  EXPECT_THROW(RegistrationCheck{calibration}, std::logic_error);
}

Registration of_recording(OpenedSource opened, int first_frame) {
  RegistrationCheck check;
  Registration result = Registration::kUndecided;
  for (int i = 0; i < first_frame + kFrames; ++i) {
    SourceResult const next = opened.source->next();
    if (auto const* frame = std::get_if<FramePtr>(&next); frame != nullptr && i >= first_frame) {
      result = check.add((*frame)->cloud_camera.z, (*frame)->color);
    }
  }
  return result;
}

PoseConfig fixed_pose() {
  PoseConfig pose;
  pose.source = PoseSource::kFixed;
  return pose;
}

TEST(RegistrationOfRecordings, OfTheKitchenIsNotDone) {
  CREDO_REQUIRE_RECORDING("kitchen");
  for (int const first : {100, 200}) {
    EXPECT_EQ(of_recording(open_dataset(test::recordings() / "kitchen", {}, fixed_pose()), first),
              Registration::kUnregistered)
        << first;
  }
}

TEST(RegistrationOfRecordings, OfTheLivingRoomIsDone) {
  CREDO_REQUIRE_RECORDING("oni/living-room.oni");
  EXPECT_EQ(of_recording(open_oni(test::recordings() / "oni/living-room.oni", {}, {}), 0),
            Registration::kRegistered);
}

TEST(RegistrationOfRecordings, OfTheOfficeIsDone) {
  CREDO_REQUIRE_RECORDING("frames/office");
  EXPECT_EQ(of_recording(open_dataset(test::recordings() / "frames/office", {}, fixed_pose()), 0),
            Registration::kRegistered);
}

}  // namespace
}  // namespace credo
