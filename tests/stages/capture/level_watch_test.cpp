#include "stages/capture/level_watch.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "support/world_scene.hpp"

namespace credo {
namespace {

using test::camera_looking_along_y;
using test::WorldScene;
using ::testing::HasSubstr;

WorldScene room() {
  return WorldScene().with_floor().with_wall(3.0).with_box({0.3, 1.5, 0.0}, {0.8, 2.0, 0.5});
}

constexpr double kPitch_rad = 0.5;
constexpr double kHeight_m = 1.3;

/// A sensor that says that it stands still, and is moved or not.
class LevelWatchTest : public ::testing::Test {
protected:
  /// What the watch says to frames of so many seconds.
  std::vector<std::string> watch(double seconds, double pitch_rad, double height_m,
                                 WorldScene const& scene = room()) {
    Frame frame = test::shot_of(scene, camera_looking_along_y(height_m, pitch_rad)).frame;
    frame.T_source_camera = camera_looking_along_y(kHeight_m, kPitch_rad);
    std::vector<std::string> told;
    for (int i = 0; i < static_cast<int>(10 * seconds); ++i) {
      frame.stamp_ns = now_ns_ += 100'000'000;
      if (std::optional<std::string> note = watch_.look(frame)) {
        told.push_back(*note);
      }
    }
    return told;
  }

  LevelWatch watch_{WorldLevel{Se3{}, true, ""}};

private:
  std::int64_t now_ns_ = 0;
};

TEST_F(LevelWatchTest, SaysNothingOfACameraThatStands) {
  EXPECT_THAT(watch(10, kPitch_rad, kHeight_m), testing::IsEmpty());
  EXPECT_THAT(watch(10, kPitch_rad + 0.02, kHeight_m - 0.02), testing::IsEmpty());
}

TEST_F(LevelWatchTest, TellsOnceThatItWasTiltedAndOnceThatItIsBack) {
  watch(2, kPitch_rad, kHeight_m);
  // 3.4 degrees.
  EXPECT_THAT(watch(10, kPitch_rad + 0.06, kHeight_m),
              testing::ElementsAre(HasSubstr("moved: the floor is 3.4 degrees off level")));
  EXPECT_THAT(watch(10, kPitch_rad, kHeight_m), testing::ElementsAre(HasSubstr("again")));
}

TEST_F(LevelWatchTest, HoldsACalibratedCameraAgainstItsCalibration) {
  watch_ = LevelWatch(WorldLevel{Se3{}, true, "", true});
  EXPECT_THAT(watch(10, kPitch_rad, kHeight_m), testing::IsEmpty());
  EXPECT_THAT(
      watch(10, kPitch_rad + 0.06, kHeight_m),
      testing::ElementsAre(HasSubstr("than at the calibration; put it back, or calibrate")));
  EXPECT_THAT(watch(10, kPitch_rad, kHeight_m),
              testing::ElementsAre(HasSubstr("as it did at the calibration again")));
}

TEST_F(LevelWatchTest, TellsThatItWasRaised) {
  EXPECT_THAT(watch(10, kPitch_rad, kHeight_m + 0.06),
              testing::ElementsAre(testing::ContainsRegex("6. mm lower")));
}

TEST_F(LevelWatchTest, WantsThreeLooks) {
  EXPECT_THAT(watch(2, kPitch_rad + 0.06, kHeight_m), testing::IsEmpty());
  EXPECT_THAT(watch(1, kPitch_rad, kHeight_m), testing::IsEmpty());
  EXPECT_THAT(watch(2, kPitch_rad + 0.06, kHeight_m), testing::IsEmpty());
  EXPECT_THAT(watch(1, kPitch_rad + 0.06, kHeight_m), testing::SizeIs(1));
}

TEST_F(LevelWatchTest, ATableBeforeTheCameraIsNoFloorThatRose) {
  EXPECT_THAT(watch(10, kPitch_rad, kHeight_m - 0.5), testing::IsEmpty());
}

TEST_F(LevelWatchTest, WithoutAFloorItSaysNothing) {
  EXPECT_THAT(watch(10, -0.3, kHeight_m, WorldScene().with_wall(3.0)), testing::IsEmpty());
}

}  // namespace
}  // namespace credo
