// Priors, models, meshes and detections that cannot be: exit 2, one line that says which file and
// what to do, and no --out. What can be lived with is a warning of one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "io/mesh_texts.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::StartsWith;

constexpr char const* kGoodObject =
    "{id: a, model: thing, position: [2, 0, 0], sigma_position_m: 0.05, sigma_rotation_rad: 0.1}";

class BadPriors : public ::testing::Test {
protected:
  void write_prior(std::string const& object) {
    write_text(folder_ / "prior.yaml", "objects:\n  - " + object + "\n");
  }
  void write_mesh_model(std::string const& mesh, std::string const& unit = "m") {
    write_prior(kGoodObject);
    write_text(folder_ / "thing.yaml", "mesh: thing.ply\nunit: " + unit + "\n");
    write_text(folder_ / "thing.ply", mesh);
  }
  Ended run(std::vector<std::string> const& more) {
    std::vector<std::string> arguments = {"run",
                                          "--source",
                                          "sim:box-on-table",
                                          "--frames",
                                          "1",
                                          "--out",
                                          (folder_ / "out").string(),
                                          "--prior",
                                          (folder_ / "prior.yaml").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return credo(arguments);
  }
  /// What the run says, the folder left out.
  std::string error(std::vector<std::string> const& more = {"--set", "detector.kind=sim"}) {
    Ended const ended = run(more);
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    return without_folder(ended.err);
  }
  [[nodiscard]] std::string without_folder(std::string text) const {
    std::string const name = folder_.path().string();
    for (std::size_t at = 0; (at = text.find(name)) != std::string::npos;) {
      text.erase(at, name.size());
    }
    return text;
  }

  TempFolder folder_;
};

TEST_F(BadPriors, AnEmptyMesh) {
  TriangleMesh empty = cube(0.2F);
  empty.triangles.clear();
  write_mesh_model(ply_text(empty));
  EXPECT_EQ(error(), "credo: /thing.ply: has no triangles; a model needs faces\n");
}

TEST_F(BadPriors, ABoxOfTwoKilometresIsInTheWrongUnit) {
  write_mesh_model(ply_text(cube(2000.0F)));
  EXPECT_EQ(error(), "credo: /thing.ply: is 2000 m across in m; should its unit be mm?\n");
}

TEST_F(BadPriors, ABoxOfAFifthOfAMillimetreToo) {
  write_mesh_model(ply_text(cube(0.2F)), "mm");
  EXPECT_EQ(error(), "credo: /thing.ply: is 0.0002 m across in mm; should its unit be m?\n");
}

TEST_F(BadPriors, AMeshThatCannotBeRead) {
  write_mesh_model("this is no mesh\n");
  EXPECT_EQ(error(),
            "credo: /thing.ply: is no mesh that can be read: Invalid .ply file: Incorrect magic "
            "number (expected 'ply' or 'PLY').\n");
}

TEST_F(BadPriors, AMeshCutShort) {
  write_mesh_model(ply_text(cube(0.2F)));
  cut_file(folder_ / "thing.ply", 0.8);
  EXPECT_EQ(error(),
            "credo: /thing.ply: PLY data are damaged or cut short in row 3 of the 12 of element "
            "'face'\n");
}

TEST_F(BadPriors, AMeshThatIsNotThere) {
  write_mesh_model("");
  fs::remove(folder_ / "thing.ply");
  EXPECT_EQ(error(), "credo: /thing.ply: mesh cannot be read\n");
}

TEST_F(BadPriors, AnOpenMeshIsAWarningOfOneLine) {
  write_mesh_model(ply_text(without_lid(cube(0.2F))));
  Ended const ended = run({"--set", "detector.kind=sim"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(without_folder(ended.err),
              StartsWith("warning: /thing.ply: the mesh is open (4 edges without a triangle on "
                         "either side) and so has no inside: what is near its surface "
                         "(region_growing.open_mesh_distance_m) counts as the object's\n"));
}

TEST_F(BadPriors, AModelThatNobodyKnows) {
  write_prior(
      "{id: a, model: nope, position: [2, 0, 0], sigma_position_m: 0.05, "
      "sigma_rotation_rad: 0.1}");
  EXPECT_EQ(error(),
            "credo: /prior.yaml: object a: no model is called nope; models are bottle, green-box, "
            "mug, table, others are told by their file\n");
}

TEST_F(BadPriors, AModelWithoutAShape) {
  write_prior(kGoodObject);
  write_text(folder_ / "thing.yaml", "name: thing\n");
  EXPECT_EQ(error(),
            "credo: /thing.yaml: give one of primitive.box, primitive.cylinder, primitive.table "
            "and mesh\n");
}

TEST_F(BadPriors, ACovarianceThatIsNotPositive) {
  write_prior(
      "{id: a, model: table, position: [2, 0, 0], sigma_position_m: [0.05, 0, 0.05], "
      "sigma_rotation_rad: -0.1}");
  EXPECT_EQ(error(),
            "credo: /prior.yaml:2:48: objects[0].sigma_position_m[1] = 0: must be in [0.00001, "
            "1000] m\ncredo: /prior.yaml:2:83: objects[0].sigma_rotation_rad = -0.1: must be in "
            "[0.00001, 100] rad\n");
}

TEST_F(BadPriors, ACovarianceThatIsNoNumber) {
  write_prior(
      "{id: a, model: table, position: [2, 0, 0], sigma_position_m: .nan, "
      "sigma_rotation_rad: 0.1}");
  EXPECT_EQ(error(),
            "credo: /prior.yaml:2:48: objects[0].sigma_position_m = .nan: must be a number\n");
}

TEST_F(BadPriors, ADetectionWhoseCovarianceIsNotPositive) {
  write_prior(
      "{id: a, model: table, position: [2, 0, 0], sigma_position_m: 0.05, "
      "sigma_rotation_rad: 0.1}");
  std::string zeros = "0";
  for (int i = 1; i < 36; ++i) {
    zeros += ",0";
  }
  write_text(folder_ / "seen.jsonl",
             R"({"frame":0,"detections":[{"type":"table","position":[0,0,2],)"
             R"("orientation_xyzw":[0,0,0,1],"covariance":[)" +
                 zeros + R"(],"score":1}]})" + "\n");
  EXPECT_EQ(error({"--set", "detector.kind=recorded", "--set",
                   "detector.file=" + (folder_ / "seen.jsonl").string()}),
            "credo: /seen.jsonl:1: detections[0].covariance: must be symmetric and positive "
            "definite\n");
}

TEST_F(BadPriors, DetectionsThatNobodyRecorded) {
  write_prior(
      "{id: a, model: table, position: [2, 0, 0], sigma_position_m: 0.05, "
      "sigma_rotation_rad: 0.1}");
  EXPECT_EQ(error({"--set", "detector.kind=recorded"}),
            "credo: detector.kind: recorded needs detector.file\n");
  EXPECT_EQ(error({"--set", "detector.kind=recorded", "--set",
                   "detector.file=" + (folder_ / "none.jsonl").string()}),
            "credo: /none.jsonl: recorded detections cannot be read\n");
}

TEST_F(BadPriors, APriorThatIsNotThere) {
  EXPECT_EQ(error(), "credo: /prior.yaml: cannot be read\n");
}

TEST_F(BadPriors, AnIdWithALineBreak) {
  write_prior(
      "{id: \"a\\nb\", model: table, position: [2, 0, 0], sigma_position_m: 0.05, "
      "sigma_rotation_rad: 0.1}");
  EXPECT_EQ(error(),
            "credo: /prior.yaml: objects[0]: id has a line break or another control character\n");
}

TEST_F(BadPriors, ADetectorWithNothingToLookForIsAWarning) {
  write_text(folder_ / "prior.yaml", "objects: []\n");
  Ended const ended = run({"--set", "detector.kind=sim"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.err, StartsWith("warning: the detector has nothing to look for: tell which "
                                    "objects are there with --prior\n"));
}

// Told as a name and as a path, one file is one model.
TEST_F(BadPriors, OneModelMayBeToldInTwoWays) {
  write_text(folder_ / "thing.yaml", "name: thing\nprimitive: {box: [0.1, 0.1, 0.1]}\n");
  std::string const rest =
      ", position: [2, 0, 0], sigma_position_m: 0.05, sigma_rotation_rad: 0.1}";
  write_prior("{id: a, model: thing" + rest + "\n  - {id: b, model: ./thing.yaml" + rest);
  EXPECT_EQ(run({"--set", "detector.kind=sim"}).code, 0);
}

}  // namespace
}  // namespace credo::test
