#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "io/dataset.hpp"
#include "stages/capture/floor_search.hpp"
#include "stages/capture/level.hpp"
#include "support/recordings.hpp"

namespace credo {
namespace {

FramePtr first_frame(std::string const& recording) {
  OpenedSource const opened = open_dataset(test::recordings() / recording, {}, {});
  return std::get<FramePtr>(opened.source->next());
}

/// How high the camera stands above what find_floor takes for the floor of the first frame.
std::optional<double> camera_height_m(std::string const& recording) {
  FramePtr const frame = first_frame(recording);
  std::optional<Plane> const floor = find_floor(frame->cloud_camera);
  return floor ? std::optional(floor->signed_distance_m(Eigen::Vector3d::Zero())) : std::nullopt;
}

TEST(LevelOfRecordings, KitchenStandsOnItsCarpetNotOnTheTable) {
  CREDO_REQUIRE_RECORDING("kitchen");
  // The table, 0.68 m below the camera, is the larger plane.
  EXPECT_NEAR(camera_height_m("kitchen").value(), 1.36, 0.05);
}

TEST(LevelOfRecordings, GrabberStandsOnItsFloor) {
  CREDO_REQUIRE_RECORDING("frames/grabber");
  EXPECT_NEAR(camera_height_m("frames/grabber").value(), 0.71, 0.03);
}

TEST(LevelOfRecordings, MilkStandsOnTheCarpet) {
  CREDO_REQUIRE_RECORDING("frames/milk");
  EXPECT_TRUE(camera_height_m("frames/milk").has_value());
}

TEST(LevelOfRecordings, NoTableTopIsAFloor) {
  CREDO_REQUIRE_RECORDING("osd");
  CREDO_REQUIRE_RECORDING("appearing-boxes/cam1");
  EXPECT_FALSE(camera_height_m("appearing-boxes/cam1").has_value());
  EXPECT_FALSE(camera_height_m("appearing-boxes/cam2").has_value());
  OpenedSource const opened = open_dataset(test::recordings() / "osd", {}, {});
  for (std::size_t i = 0; i < *opened.frame_count; ++i) {
    auto const frame = std::get<FramePtr>(opened.source->next());
    EXPECT_FALSE(find_floor(frame->cloud_camera).has_value()) << "osd " << i;
  }
}

}  // namespace
}  // namespace credo
