// Poses that jitter or stray, through the real program: what is believed of the camera is nearer to
// the truth than what was told.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "end_to_end/program.hpp"
#include "support/paths.hpp"

namespace credo::test {
namespace {

using nlohmann::json;

class Drift : public ::testing::Test {
protected:
  /// The demo's room at ten frames a second, with these keys of its camera.
  void simulate(std::string const& keys) {
    std::string scene = read_text(source_folder() / "scenes/first-light.yaml");
    std::string const camera = "camera:\n";
    scene.replace(scene.find(camera), camera.size(),
                  camera + "  frames_per_s: 10\n  sensor: disparity\n" + keys);
    std::ofstream(folder_ / "scene.yaml") << scene;
    Ended const ended = credo(
        {"simulate", (folder_ / "scene.yaml").string(), "--out", (folder_ / "truth").string()});
    ASSERT_EQ(ended.code, 0) << ended.err;
  }
  /// Of a run with these arguments.
  json scores(std::vector<std::string> const& more = {"--set", "fusion.drift.enabled=true"}) {
    std::vector<std::string> arguments = {
        "run",      "--source", "dataset:" + (folder_ / "truth").string(),
        "--no-dds", "--out",    (folder_ / "run").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Ended const ran = credo(arguments);
    EXPECT_EQ(ran.code, 0) << ran.err;
    Ended const ended = credo(
        {"eval", (folder_ / "run").string(), "--truth", (folder_ / "truth").string(), "--json"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return json::parse(ended.out);
  }

  TempFolder folder_;
};

TEST_F(Drift, JitterIsHalvedAtLeast) {
  simulate("  pose_jitter_m: 0.005\n  pose_jitter_rad: 0.004\n");
  json const s = scores();
  double const told_m = s["camera_told"]["ate_m"];
  EXPECT_GT(told_m, 0.007) << "or there is nothing to correct";
  EXPECT_LT(s["camera"]["ate_m"], 0.5 * told_m);
}

TEST_F(Drift, WhatStraysIsHeld) {
  simulate("  pose_drift_m_per_s: 0.01\n  pose_drift_rad_per_s: 0.004\n");
  json const s = scores();
  double const told_m = s["camera_told"]["translation_m"];
  double const told_deg = s["camera_told"]["rotation_deg"];
  EXPECT_GT(told_m, 0.015) << "or there is nothing to correct";
  EXPECT_LT(s["camera"]["translation_m"], 0.5 * told_m);
  EXPECT_LT(s["camera"]["rotation_deg"], 0.5 * told_deg);
}

TEST_F(Drift, WhatIsToldTrulyStaysTrue) {
  simulate("");
  json const s = scores();
  EXPECT_LT(s["camera_told"]["translation_m"], 1e-6);
  EXPECT_LT(s["camera"]["translation_m"], 0.004);
  EXPECT_LT(s["camera"]["rotation_deg"], 0.15);
}

TEST_F(Drift, SwitchedOffTheCameraStandsWhereItIsTold) {
  simulate("  pose_jitter_m: 0.005\n  pose_jitter_rad: 0.004\n");
  json const s = scores({"--set", "fusion.drift.enabled=false", "--set", "pose.level=off"});
  EXPECT_NEAR(s["camera"]["translation_m"], s["camera_told"]["translation_m"], 1e-6);
  EXPECT_NEAR(s["camera"]["rotation_deg"], s["camera_told"]["rotation_deg"], 1e-4);
}

}  // namespace
}  // namespace credo::test
