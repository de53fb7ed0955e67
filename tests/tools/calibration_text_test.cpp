#include "tools/calibration_text.hpp"

#include <gmock/gmock.h>

#include <string>

namespace credo::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kDegree = 0.017453292519943295;

StillSurface surface(int frames, std::size_t points, double rms_m) {
  StillSurface result;
  result.frame_count = frames;
  result.point_count = points;
  result.rms_m = rms_m;
  return result;
}

Calibration with_floor() {
  Calibration calibration;
  calibration.camera = {20.0 * kDegree, -1e-9, 1.23456, 0.0, 0.0, 0.0};
  calibration.spread = CameraStand{0.01 * kDegree, 0.02 * kDegree, 0.0004, 0.0, 0.0, 0.0};
  calibration.floor = surface(30, 12345, 0.0062);
  return calibration;
}

Calibration with_wall() {
  Calibration calibration = with_floor();
  calibration.camera.yaw_rad = 90.0 * kDegree;
  calibration.camera.x_m = 2.5;
  calibration.spread->yaw_rad = 0.03 * kDegree;
  calibration.spread->x_m = 0.001;
  calibration.wall = surface(29, 999, 0.004);
  calibration.wall_lean_rad = -0.2 * kDegree;
  return calibration;
}

CalibrationOrigin const kOrigin = {"openni:", 30};

TEST(CalibrationTable, HasAValueAndItsSpreadInARow) {
  EXPECT_EQ(calibration_table(with_wall(), kOrigin),
            "              camera       spread over frames\n"
            "pitch        20.000 deg      0.010 deg\n"
            "roll          0.000 deg      0.020 deg\n"
            "height       1.2346 m         0.40 mm\n"
            "yaw          90.000 deg      0.030 deg\n"
            "to wall      2.5000 m         1.00 mm\n"
            "floor   in 30 of 30 frames, 12345 points, 6.2 mm rms\n"
            "wall    in 29 of 30 frames, 999 points, 4.0 mm rms, 0.20 deg off upright\n");
}

TEST(CalibrationTable, WithoutAWallSaysNothingOfIt) {
  Calibration calibration = with_floor();
  calibration.spread.reset();
  std::string const table = calibration_table(calibration, {"a", 1});
  EXPECT_THAT(table, Not(HasSubstr("wall")));
  EXPECT_THAT(table, Not(HasSubstr("yaw")));
  EXPECT_THAT(table, HasSubstr("height       1.2346 m            -\n"));
}

TEST(CalibrationYaml, IsAnOverlayThatSaysWhereItComesFrom) {
  EXPECT_EQ(calibration_yaml(with_wall(), kOrigin),
            "# Where the camera of openni: stands, by credo calibrate.\n"
            "# Floor (z = 0) in 30 of 30 frames, 12345 points, 6.2 mm rms.\n"
            "# Wall (x = 0, the camera at y = 0) in 29 of 30 frames, 999 points, 4.0 mm rms.\n"
            "pose:\n"
            "  level: given\n"
            "  camera_pitch_rad: 0.349066\n"
            "  camera_roll_rad: 0.000000\n"
            "  camera_height_m: 1.234560\n"
            "  camera_yaw_rad: 1.570796\n"
            "  camera_x_m: 2.500000\n"
            "  camera_y_m: 0.000000\n");
}

TEST(CalibrationYaml, NoNameOfASourceBreaksItsComment) {
  EXPECT_THAT(calibration_yaml(with_floor(), {"dataset:a\npose: b", 3}),
              testing::StartsWith("# Where the camera of dataset:a pose: b stands"));
}

TEST(CalibrationWarnings, AreNoneWhereAllIsWell) {
  EXPECT_THAT(calibration_warnings(with_floor(), kOrigin), IsEmpty());
}

TEST(CalibrationWarnings, TellWhatToDoubt) {
  Calibration calibration = with_wall();
  calibration.floor.frame_count = 28;
  calibration.wall_lean_rad = -3.0 * kDegree;
  calibration.spread->x_m = 0.02;
  EXPECT_THAT(
      calibration_warnings(calibration, kOrigin),
      ElementsAre(HasSubstr("2 of 30 frames"),
                  HasSubstr("differ by 0.03 degrees and 20 mm: either the camera moved, or too "
                            "little of the floor or the wall is in view"),
                  HasSubstr("the wall stands 3.0 degrees off upright")));
}

TEST(CalibrationWarnings, CountEverySpread) {
  for (auto const member : {&CameraStand::pitch_rad, &CameraStand::roll_rad, &CameraStand::yaw_rad,
                            &CameraStand::height_m, &CameraStand::x_m}) {
    Calibration calibration = with_wall();
    (*calibration.spread).*member = 0.011;  // 0.63 degrees or 11 mm
    EXPECT_THAT(calibration_warnings(calibration, kOrigin), ElementsAre(HasSubstr("differ by")));
    (*calibration.spread).*member = 0.008;
    EXPECT_THAT(calibration_warnings(calibration, kOrigin), IsEmpty());
  }
}

TEST(CalibrationWarnings, OneFrameTellsNothingOfItself) {
  Calibration calibration = with_floor();
  calibration.floor.frame_count = 1;
  calibration.spread.reset();
  EXPECT_THAT(calibration_warnings(calibration, {"a", 1}),
              ElementsAre(HasSubstr("one frame only")));
}

}  // namespace
}  // namespace credo::test
