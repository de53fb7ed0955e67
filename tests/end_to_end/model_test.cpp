// credo model: meshes of what was seen, and credo detect that finds them; prepared models that are
// kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "core/se3.hpp"
#include "end_to_end/known_scene.hpp"
#include "end_to_end/program.hpp"
#include "io/image.hpp"
#include "io/mesh_file.hpp"
#include "sim/camera_path.hpp"
#include "sim/scene_time.hpp"
#include "support/milk_pose.hpp"
#include "support/paths.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Se3 pose_of(json const& detection) {
  auto const p = detection["position"].get<std::vector<double>>();
  auto const q = detection["orientation_xyzw"].get<std::vector<double>>();
  return {Eigen::Quaterniond(q.at(3), q.at(0), q.at(1), q.at(2)), {p.at(0), p.at(1), p.at(2)}};
}

Eigen::AlignedBox3d bounds_of(fs::path const& mesh) {
  Eigen::AlignedBox3d bounds;
  for (Eigen::Vector3f const& vertex : read_mesh(mesh, LengthUnit::kMetre).mesh.vertices) {
    bounds.extend(vertex.cast<double>());
  }
  return bounds;
}

/// How far the middle of a mesh is from where it truly is, and the turn between them.
struct PoseError {
  double distance_m = 0.0;
  double angle_deg = 0.0;
};
PoseError error_of(Se3 const& pose, Se3 const& truth, Eigen::Vector3d const& middle) {
  return {
      (pose * middle - truth * middle).norm(),
      so3_log(pose.rotation().conjugate() * truth.rotation()).norm() * 180.0 / std::numbers::pi};
}

class Model : public ::testing::Test {
protected:
  [[nodiscard]] std::string path(std::string const& name) const {
    return (folder_ / name).string();
  }

  TempFolder folder_;
};

constexpr char const* kBoxOnTable = "sim:box-on-table";
/// The green box of that scene: 0.2 x 0.15 x 0.25 m on a table 0.72 m high.
std::vector<std::string> const kAroundBox = {"1.8", "-0.1", "0.726", "2.2", "0.3", "1.1"};

std::vector<std::string> learn_box(std::string const& out) {
  std::vector<std::string> arguments = {"model", "--source", kBoxOnTable, "--out", out, "--box"};
  arguments.insert(arguments.end(), kAroundBox.begin(), kAroundBox.end());
  return arguments;
}

TEST_F(Model, OfPosedFramesIsFoundInAnotherFrame) {
  std::vector<std::string> arguments = learn_box(path("box.ply"));
  arguments.insert(arguments.end(), {"--frames", "1:8", "--picture", path("box.png"), "--set",
                                     "sim.sensor=disparity"});
  Ended const made = credo(arguments);
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, StartsWith(path("box.ply") + ": "));
  EXPECT_THAT(made.out, HasSubstr("of 8 views"));
  EXPECT_THAT(made.out, HasSubstr("origin: the middle of the box, 2.0000 0.1000 0.9130\n"));
  Eigen::AlignedBox3d const bounds = bounds_of(folder_ / "box.ply");
  EXPECT_NEAR(bounds.min().z(), 0.726 - 0.913, 0.01);
  EXPECT_NEAR(bounds.max().z(), 0.97 - 0.913, 0.01);
  Grid<Rgb> const picture = read_color(folder_ / "box.png");
  EXPECT_GT(picture.width(), picture.height());

  Ended const found = credo({"detect", "--source", kBoxOnTable, "--frame", "0", "--model",
                             path("box.ply"), "--json", "--set", "sim.sensor=disparity"});
  ASSERT_EQ(found.code, 0) << found.err;
  json const list = json::parse(found.out);
  ASSERT_EQ(list.size(), 1U) << found.out;
  EXPECT_EQ(list[0]["type"], "box");
  Scene const scene = project_scene("box-on-table");
  Se3 const T_world_camera = camera_pose(scene.camera.path, scene_time_s(scene, FrameIndex{0}));
  Se3 const T_world_model(Eigen::Quaterniond::Identity(), {2.0, 0.1, 0.913});
  PoseError const error =
      error_of(pose_of(list[0]), T_world_camera.inverse() * T_world_model, bounds.center());
  EXPECT_LT(error.distance_m, 0.01);
  EXPECT_LT(error.angle_deg, 5.0);
}

TEST_F(Model, OnlyTheFramesThatAreToldAreUsed) {
  std::vector<std::string> arguments = learn_box(path("box.ply"));
  arguments.insert(arguments.end(), {"--frames", "2:3"});
  Ended const made = credo(arguments);
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("of 2 views"));
}

TEST_F(Model, IsTheSameEachTime) {
  ASSERT_EQ(credo(learn_box(path("a.ply"))).code, 0);
  ASSERT_EQ(credo(learn_box(path("b.ply"))).code, 0);
  EXPECT_EQ(read_text(folder_ / "a.ply"), read_text(folder_ / "b.ply"));
}

TEST_F(Model, TheMilkCartonIsFoundWhereItStands) {
  CREDO_REQUIRE_RECORDING("objects/milk.pcd");
  CREDO_REQUIRE_RECORDING("frames/milk");
  Ended const made = credo({"model", (recordings() / "objects/milk.pcd").string(), "--out",
                            path("milk.ply"), "--picture", path("milk.png")});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("12575 points of 1 view,"));
  EXPECT_THAT(made.out, HasSubstr("origin: the cloud's own\n"));
  Ended const found =
      credo({"detect", "--source", "dataset:" + (recordings() / "frames/milk").string(), "--model",
             path("milk.ply"), "--json"});
  ASSERT_EQ(found.code, 0) << found.err;
  json const list = json::parse(found.out);
  ASSERT_EQ(list.size(), 1U) << found.out;
  PoseError const error =
      error_of(pose_of(list[0]), true_milk_pose(), bounds_of(folder_ / "milk.ply").center());
  EXPECT_LT(error.distance_m, 0.01);
  EXPECT_LT(error.angle_deg, 5.0);
}

TEST_F(Model, APartOfACloudIsCutOutByABox) {
  CREDO_REQUIRE_RECORDING("objects/milk.pcd");
  std::string const cloud = (recordings() / "objects/milk.pcd").string();
  ASSERT_EQ(credo({"model", cloud, "--out", path("all.ply")}).code, 0);
  Eigen::AlignedBox3d const all = bounds_of(folder_ / "all.ply");
  Eigen::Vector3d const low = all.min() - Eigen::Vector3d::Constant(0.01);
  Eigen::Vector3d high = all.max() + Eigen::Vector3d::Constant(0.01);
  high.x() = all.center().x();
  std::vector<std::string> arguments = {"model", cloud, "--out", path("half.ply"), "--box"};
  for (Eigen::Vector3d const& corner : {low, high}) {
    for (double const value : corner) {
      arguments.push_back(std::to_string(value));
    }
  }
  Ended const made = credo(arguments);
  ASSERT_EQ(made.code, 0) << made.err;
  Eigen::AlignedBox3d const half = bounds_of(folder_ / "half.ply");
  EXPECT_NEAR(half.sizes().x(), all.sizes().x() / 2.0, 0.01);
  EXPECT_NEAR(half.max().x(), (high.x() - low.x()) / 2.0, 0.01) << "from the middle of the box";
}

TEST_F(Model, BadInputIsOneLineAndExitWith2) {
  write_text(folder_ / "few.pcd",
             "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
             "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n0 0 1\n0.1 0 1\n");
  std::string const cloud = path("few.pcd");
  std::string const out = path("out.ply");
  struct Case {
    std::vector<std::string> arguments;
    std::string text;
  };
  std::vector<Case> const cases = {
      {{cloud}, "--out is required"},
      {{"--out", out}, "give a cloud or --source"},
      {{cloud, "--source", kBoxOnTable, "--out", out}, "give a cloud or --source"},
      {{cloud, "--out", path("out.stl")}, "NAME.ply"},
      {{cloud, "--out", out}, "makes no surface: its 2 points"},
      {{path("nowhere.pcd"), "--out", out}, "nowhere.pcd: no such file"},
      {{cloud, "--frames", "0:3", "--out", out}, "--frames is for --source"},
      {{cloud, "--box", "1", "1", "1", "0", "2", "2", "--out", out}, "--box: its second corner"},
      {{cloud, "--box", "5", "5", "5", "6", "6", "6", "--out", out}, "no point in the box"},
      {{cloud, "--box", "1", "2", "--out", out}, "--box"},
      {{"--source", kBoxOnTable, "--out", out}, "--source needs --box"},
      {{"--source", "sim:nowhere", "--box", "0", "0", "0", "1", "1", "1", "--out", out}, "nowhere"},
      {{"--source", kBoxOnTable, "--box", "0", "0", "0", "1", "1", "1", "--frames", "3:2", "--out",
        out},
       "--frames 3:2: write FIRST:LAST"},
      {{"--source", kBoxOnTable, "--box", "0", "0", "0", "1", "1", "1", "--frames", "5", "--out",
        out},
       "--frames 5: write FIRST:LAST"},
      {{"--source", kBoxOnTable, "--box", "7", "7", "7", "8", "8", "8", "--out", out},
       "no point in the box"}};
  for (Case const& one : cases) {
    std::vector<std::string> arguments = {"model"};
    arguments.insert(arguments.end(), one.arguments.begin(), one.arguments.end());
    Ended const ended = credo(arguments);
    EXPECT_EQ(ended.code, 2) << one.text;
    EXPECT_EQ(ended.out, "") << one.text;
    EXPECT_THAT(ended.err, StartsWith("credo: "));
    EXPECT_THAT(ended.err, HasSubstr(one.text));
    EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
    EXPECT_FALSE(fs::exists(out));
  }
}

TEST_F(Model, DetectKeepsWhatItPrepared) {
  std::vector<std::string> const arguments = {
      "detect",    "--source", kBoxOnTable, "--model",
      "green-box", "--json",   "--set",     "detector.bpa.cache_dir=" + path("cache")};
  Ended const first = credo(arguments);
  ASSERT_EQ(first.code, 0) << first.err;
  ASSERT_TRUE(fs::exists(folder_ / "cache"));
  fs::path const kept = fs::directory_iterator(folder_ / "cache")->path();
  auto const written = fs::last_write_time(kept);
  EXPECT_EQ(credo(arguments).out, first.out);
  EXPECT_EQ(fs::last_write_time(kept), written) << "it is read, not made anew";
  cut_file(kept, 0.5);
  EXPECT_EQ(credo(arguments).out, first.out);
  EXPECT_GT(fs::last_write_time(kept), written);
}

TEST_F(Model, RunKeepsWhatItPrepared) {
  Ended const ended =
      credo({"run", "--source", kBoxOnTable, "--frames", "1", "--prior",
             (source_folder() / "scenes/priors/box-on-table.yaml").string(), "--no-dds", "--set",
             "detector.kind=bpa", "--set", "detector.bpa.cache_dir=" + path("cache")});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_FALSE(fs::is_empty(folder_ / "cache"));
}

}  // namespace
}  // namespace credo::test
