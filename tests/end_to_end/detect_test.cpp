// credo detect: known objects found in one frame by the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "end_to_end/known_scene.hpp"
#include "end_to_end/program.hpp"
#include "geometry/shapes/model_mesh.hpp"
#include "io/image.hpp"
#include "io/mesh_file.hpp"
#include "sim/camera_path.hpp"
#include "sim/scene_time.hpp"
#include "support/linemod_cat.hpp"
#include "support/paths.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Se3 pose_of(json const& detection) {
  auto const p = detection["position"].get<std::vector<double>>();
  auto const q = detection["orientation_xyzw"].get<std::vector<double>>();
  return {Eigen::Quaterniond(q.at(3), q.at(0), q.at(1), q.at(2)), {p.at(0), p.at(1), p.at(2)}};
}

/// Mean distance of a mesh's corners at two poses.
double add_m(std::vector<Eigen::Vector3f> const& vertices, Se3 const& a, Se3 const& b) {
  double sum = 0.0;
  for (Eigen::Vector3f const& vertex : vertices) {
    Eigen::Vector3d const p = vertex.cast<double>();
    sum += (a * p - b * p).norm();
  }
  return sum / static_cast<double>(vertices.size());
}

double diameter_m(std::vector<Eigen::Vector3f> const& vertices) {
  float most = 0.0F;
  std::size_t const step = 1 + vertices.size() / 2000;
  for (std::size_t i = 0; i < vertices.size(); i += step) {
    for (std::size_t j = 0; j < i; j += step) {
      most = std::max(most, (vertices[i] - vertices[j]).norm());
    }
  }
  return static_cast<double>(most);
}

Se3 true_camera(Scene const& scene, std::int64_t frame) {
  return camera_pose(scene.camera.path, scene_time_s(scene, FrameIndex{frame}));
}

/// The pose and those that look the same: a box turned by half about its middle.
std::vector<Se3> box_poses(Se3 const& pose, Eigen::Vector3d const& middle) {
  std::vector<Se3> poses = {pose};
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Quaterniond const half(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::Unit(axis)));
    poses.push_back(pose * Se3(half, middle - half * middle));
  }
  return poses;
}

class Detect : public ::testing::Test {
protected:
  /// Finds the green box in a frame of box-on-table.
  static void expect_box(json const& box, std::int64_t frame) {
    Scene const scene = project_scene("box-on-table");
    Se3 const truth = true_camera(scene, frame).inverse() * true_pose(scene, frame, "box");
    auto const vertices = mesh_of(project_model("green-box")).vertices;
    double least_m = std::numeric_limits<double>::infinity();
    for (Se3 const& same : box_poses(truth, {0, 0, 0.125})) {
      least_m = std::min(least_m, add_m(vertices, pose_of(box), same));
    }
    EXPECT_LT(least_m, 0.1 * diameter_m(vertices));
    EXPECT_EQ(box["type"], "green-box");
    EXPECT_GT(box["score"], 0.5);
    EXPECT_GT(box["visible_fraction"], 0.5);
    EXPECT_EQ(box["covariance"].size(), 36U);
  }

  TempFolder folder_;
};

TEST_F(Detect, FindsABoxWhereItTrulyIs) {
  Ended const ended =
      credo({"detect", "--source", "sim:box-on-table", "--model", "green-box", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  json const list = json::parse(ended.out);
  ASSERT_EQ(list.size(), 1U) << ended.out;
  expect_box(list[0], 0);
}

TEST_F(Detect, LooksAtTheFrameThatItIsTold) {
  Ended const ended = credo(
      {"detect", "--source", "sim:box-on-table", "--frame", "3", "--model", "green-box", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  json const list = json::parse(ended.out);
  ASSERT_EQ(list.size(), 1U) << ended.out;
  expect_box(list[0], 3);
}

TEST_F(Detect, TellsATableAndDrawsAPicture) {
  fs::path const picture = folder_ / "found.png";
  Ended const ended = credo({"detect", "--source", "sim:box-on-table", "--model", "green-box",
                             "mug", "--picture", picture.string()});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, StartsWith("object"));
  EXPECT_THAT(ended.out, HasSubstr("\ngreen-box"));
  EXPECT_THAT(ended.out, HasSubstr("\nmug                  not found\n"));
  Grid<Rgb> const drawn = read_color(picture);
  EXPECT_EQ(drawn.width(), 640);
  EXPECT_EQ(drawn.height(), 480);
}

TEST_F(Detect, WhatIsUnlikelierThanAskedIsNotTold) {
  Ended const ended = credo({"detect", "--source", "sim:box-on-table", "--model", "green-box",
                             "--json", "--set", "detector.bpa.min_probability=0.999999"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "[]\n");
}

TEST_F(Detect, SaysTheSameEachTime) {
  std::vector<std::string> const arguments = {"detect",  "--source",  "sim:box-on-table",
                                              "--model", "green-box", "--json"};
  EXPECT_EQ(credo(arguments).out, credo(arguments).out);
}

TEST_F(Detect, BadInputIsOneLineAndExitWith2) {
  write_text(folder_ / "empty.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nelement face 0\nproperty list uchar int vertex_indices\n"
             "end_header\n0 0 0\n1 0 0\n0 1 0\n");
  write_text(folder_ / "empty.yaml", "name: empty\nmesh: empty.ply\nunit: m\n");
  write_text(folder_ / "flat.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
             "end_header\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  write_text(folder_ / "flat.yaml", "name: flat\nmesh: flat.ply\nunit: m\n");
  write_text(folder_ / "nonsense.yaml", "nmae: cup\n");
  struct Case {
    std::vector<std::string> arguments;
    std::string text;
  };
  std::vector<Case> const cases = {
      {{"--model", (folder_ / "nowhere.yaml").string()}, "nowhere.yaml"},
      {{"--model", (folder_ / "nonsense.yaml").string()}, "nonsense.yaml"},
      {{"--model", (folder_ / "empty.yaml").string()}, "empty.ply"},
      {{"--model", (folder_ / "flat.yaml").string()}, "flat"},
      {{"--model", "green-box", "--frame", "100000"}, "has no frame 100000"},
      {{"--model", "green-box", "--frame", "-1"}, "--frame"},
      {{"--model", "green-box", "green-box"}, "another model is called green-box"},
      {{"--model", "green-box", "--set", "detector.bpa.min_probability=2"}, "min_probability"},
      {{"--model", "green-box", "--picture", (folder_ / "no/such/found.png").string()},
       "found.png"},
      {{}, "--model is required"}};
  for (Case const& one : cases) {
    std::vector<std::string> arguments = {"detect", "--source", "sim:box-on-table"};
    arguments.insert(arguments.end(), one.arguments.begin(), one.arguments.end());
    Ended const ended = credo(arguments);
    EXPECT_EQ(ended.code, 2) << one.text;
    EXPECT_EQ(ended.out, "") << one.text;
    EXPECT_THAT(ended.err, StartsWith("credo: "));
    EXPECT_THAT(ended.err, HasSubstr(one.text));
    EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
  }
}

TEST_F(Detect, FindsTheCatOnARealDesk) {
  CREDO_REQUIRE_RECORDING("frames/linemod-cat");
  CREDO_REQUIRE_RECORDING("objects/lmo/obj_000006.ply");
  fs::path const mesh = recordings() / "objects/lmo/obj_000006.ply";
  write_text(folder_ / "cat.yaml", "name: cat\nmesh: " + mesh.string() + "\nunit: mm\n");
  Ended const ended =
      credo({"detect", "--source", "dataset:" + (recordings() / "frames/linemod-cat").string(),
             "--model", (folder_ / "cat.yaml").string(), "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  json const list = json::parse(ended.out);
  ASSERT_EQ(list.size(), 1U) << ended.out;
  auto const vertices = read_mesh(mesh, LengthUnit::kMillimetre).mesh.vertices;
  EXPECT_LT(add_m(vertices, pose_of(list[0]), true_cat_pose()), 0.1 * diameter_m(vertices));
}

}  // namespace
}  // namespace credo::test
