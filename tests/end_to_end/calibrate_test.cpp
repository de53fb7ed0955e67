// `credo calibrate` from end to end: what it writes, what a run makes of it, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

/// A room with a wall 3 m before the camera, turned by 20 degrees against the scene's axes; its
/// camera looks along the scene's +x, 1.25 m up.
constexpr char const* kRoom = R"(things:
  - {name: floor, kind: floor, shape: box, size_m: [12, 12, 0.1], position_m: [0, 0, -0.1]}
  - {name: wall, kind: wall, shape: box, size_m: [0.1, 7, 2.5], position_m: [3.4, 0, 0], rpy_deg: [0, 0, 20]}
  - {name: crate, shape: box, size_m: [0.4, 0.4, 0.4], position_m: [2.2, 0.5, 0]}
camera:
  frames_per_s: 10
  sensor: disparity
  path:
    - {time_s: 0, position_m: [0, 0, 1.25], look_at_m: [2.5, 0, 0.2]}
    - {time_s: 0.5, position_m: [0, 0, 1.25], look_at_m: [2.5, 0, 0.2]}
)";

class Calibrate : public ::testing::Test {
protected:
  Calibrate() { write_text(folder_ / "room.yaml", kRoom); }

  [[nodiscard]] std::string room() const { return "sim:" + (folder_ / "room.yaml").string(); }
  [[nodiscard]] std::string file(std::string const& name) const {
    return (folder_ / name).string();
  }
  Ended calibrate(std::string const& source, std::vector<std::string> const& more = {}) {
    std::vector<std::string> arguments = {"calibrate", "--source", source, "--out",
                                          file("camera.yaml")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return credo(arguments);
  }
  /// The last line of a run with the calibration.
  json believed(std::string const& source) {
    Ended const ended = credo({"run", "--no-dds", "--source", source, "--config",
                               file("camera.yaml"), "--out", file("run")});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("the camera stands as given: 1.25 m up"));
    return json::parse(read_lines(folder_ / "run/belief.jsonl").back());
  }

  TempFolder folder_;
};

// The camera sees the wall's near face at 3.4 cos 20 - 0.05 m.
double const kWallDistance_m = 3.4 * std::cos(20.0 * std::numbers::pi / 180.0) - 0.05;

TEST_F(Calibrate, ARunStandsInTheWorldOfTheWall) {
  Ended const ended = calibrate(room(), {"--wall", "--picture", file("camera.png")});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("\nheight"));
  EXPECT_TRUE(fs::exists(folder_ / "camera.png"));
  json const belief = believed(room());
  // x out of the wall, which is turned by 20 degrees: the view, along -x but for that, is turned by
  // as much; it is pitched by atan(1.05 / 2.5). A Kinect's steps leave a milliradian.
  double const turn = -20.0 * std::numbers::pi / 180.0;
  double const pitch = std::atan2(1.05, 2.5);
  auto const T = belief["T_world_camera"].get<std::array<double, 16>>();
  EXPECT_NEAR(T[3], kWallDistance_m, 0.005);
  EXPECT_NEAR(T[7], 0.0, 1e-9);
  EXPECT_NEAR(T[11], 1.25, 0.003);
  EXPECT_NEAR(T[2], -std::cos(turn) * std::cos(pitch), 0.002);
  EXPECT_NEAR(T[6], -std::sin(turn) * std::cos(pitch), 0.002);
  EXPECT_NEAR(T[10], -std::sin(pitch), 0.002);
  EXPECT_NEAR(T[8], 0.0, 0.002) << "no roll";
  EXPECT_NEAR(belief["floor"]["height_m"].get<double>(), 0.0, 0.005);
  // The wall lies on x = 0, where it was put.
  ASSERT_FALSE(belief["walls"].empty());
  for (json const& end : belief["walls"][0]["segment"]) {
    EXPECT_NEAR(end[0].get<double>(), 0.0, 0.03);
  }
  EXPECT_GT(std::abs(belief["walls"][0]["normal"][0].get<double>()), 0.9995);
}

TEST_F(Calibrate, WithoutAWallKeepsTheCamerasOwnYaw) {
  ASSERT_EQ(calibrate(room(), {"--frames", "3"}).code, 0);
  EXPECT_THAT(read_text(folder_ / "camera.yaml"), HasSubstr("in 3 of 3 frames"));
  json const belief = believed(room());
  auto const T = belief["T_world_camera"].get<std::array<double, 16>>();
  EXPECT_NEAR(T[3], 0.0, 1e-9);
  EXPECT_NEAR(T[7], 0.0, 1e-9);
  EXPECT_NEAR(T[11], 1.25, 0.003);
  EXPECT_NEAR(T[2], 0.0, 0.002) << "looks along +y";
  EXPECT_GT(T[6], 0.9);
}

TEST_F(Calibrate, OverwritesNothing) {
  write_text(folder_ / "camera.yaml", "mine\n");
  Ended const ended = calibrate(room());
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "credo: --out " + file("camera.yaml") +
                           ": exists; name another file, or remove it first\n");
  EXPECT_EQ(read_text(folder_ / "camera.yaml"), "mine\n");
}

TEST_F(Calibrate, RefusesAPictureThatExistsBeforeItLooks) {
  write_text(folder_ / "camera.png", "mine\n");
  Ended const ended = calibrate(room(), {"--picture", file("camera.png")});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--picture " + file("camera.png") + ": exists"));
  EXPECT_FALSE(fs::exists(folder_ / "camera.yaml"));
}

TEST_F(Calibrate, RefusesWhatItCannotUse) {
  struct Case {
    std::string source;
    std::vector<std::string> more;
    std::string told;
  };
  std::string const upwards = "sim:" + file("upwards.yaml");
  std::string text = kRoom;
  for (std::string const aim = "0.2]"; text.find(aim) != std::string::npos;) {
    text.replace(text.find(aim), aim.size(), "2.0]");
  }
  write_text(folder_ / "upwards.yaml", text);
  std::string const yard = "sim:" + file("yard.yaml");
  text = kRoom;
  std::size_t const wall = text.find("  - {name: wall");
  write_text(folder_ / "yard.yaml", text.erase(wall, text.find('\n', wall) + 1 - wall));
  for (Case const& bad : {
           Case{"sim:first-light", {}, "the camera moves: its poses say 1"},
           Case{upwards, {}, "the floor is in view in 0 of 6 frames"},
           Case{yard, {"--wall"}, "no wall in view"},
           Case{room(), {"--frames", "0"}, "--frames: "},
           Case{room(), {"--frames", "301"}, "--frames: "},
           Case{"sim:nowhere", {}, "no such scene or file"},
           Case{room(), {"--set", "pose.levle=off"}, "did you mean level?"},
           Case{room(), {"--picture", file("none/camera.png")}, "no folder " + file("none")},
       }) {
    Ended const ended = calibrate(bad.source, bad.more);
    EXPECT_EQ(ended.code, 2) << bad.told;
    EXPECT_THAT(ended.err, HasSubstr(bad.told));
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(fs::exists(folder_ / "camera.yaml"));
  }
}

TEST_F(Calibrate, MovingPosesMayBeSetAside) {
  // Its frames differ all the same, but by less than a frame of a walk.
  Ended const ended = calibrate("sim:first-light", {"--frames", "2", "--set", "pose.source=fixed"});
  EXPECT_EQ(ended.code, 0) << ended.err;
}

TEST_F(Calibrate, ARealRoom) {
  CREDO_REQUIRE_RECORDING("oni/living-room.oni");
  Ended const ended =
      calibrate("oni:" + (recordings() / "oni/living-room.oni").string(), {"--wall"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("12 of 12 frames"));
}

}  // namespace
}  // namespace credo::test
