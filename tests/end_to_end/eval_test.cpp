// credo eval on a simulated scene: a run made of the truth is perfect, known faults in its files
// move what they should; what does not fit is told in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/label.hpp"
#include "end_to_end/program.hpp"
#include "io/image.hpp"
#include "support/paths.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Eval : public ::testing::Test {
protected:
  /// Three looks at a table and a box on it; a run that believes what is true of them.
  void SetUp() override {
    Ended const ended = credo({"simulate", "thesis-4.4.1", "--out", truth().string()});
    ASSERT_EQ(ended.code, 0) << ended.err;
    fs::create_directories(run());
    fs::copy(truth() / "truth", run() / "labels");
    for (std::string const& line : read_lines(truth() / "truth.jsonl")) {
      beliefs_.push_back(belief_of(json::parse(line)));
    }
    write_beliefs();
  }

  static json belief_of(json const& truth) {
    json belief = truth;
    belief.erase("events");
    belief["segmented_with"] = -1;
    belief["walls"] = json::array();
    belief["floor"]["points"] = 1000;
    for (json& object : belief["objects"]) {
      object["probability"] = 0.99;
      object["evidence"] = "seen";
      object["covariance"] = std::vector<double>(36, 0.0);
      for (std::size_t i = 0; i < 6; ++i) {
        object["covariance"][7 * i] = 1e-4;
      }
    }
    return belief;
  }
  void write_beliefs() const {
    std::ofstream file(run() / "belief.jsonl");
    for (json const& belief : beliefs_) {
      file << belief.dump() << '\n';
    }
  }
  [[nodiscard]] json scores() const {
    Ended const ended = credo({"eval", run().string(), "--truth", truth().string(), "--json"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return json::parse(ended.out);
  }
  /// The one line of an eval that is refused.
  std::string refusal() const {
    Ended const ended = credo({"eval", run().string(), "--truth", truth().string()});
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_EQ(ended.out, "");
    return ended.err;
  }
  [[nodiscard]] fs::path run() const { return folder_ / "run"; }
  [[nodiscard]] fs::path truth() const { return folder_ / "truth"; }

  TempFolder folder_;
  std::vector<json> beliefs_;
};

TEST_F(Eval, OfTheTruthItselfIsPerfect) {
  json const s = scores();
  EXPECT_EQ(s["frames"], 3);
  EXPECT_EQ(s["segmentation"]["wov"], 1.0);
  EXPECT_EQ(s["segmentation"]["f_os"], 0.0);
  EXPECT_EQ(s["segmentation"]["f_us"], 0.0);
  EXPECT_EQ(s["segmentation"]["recall_50"], 1.0);
  EXPECT_EQ(s["segmentation"]["iou"], json::parse(R"({"floor": 1.0, "object": 1.0})"));
  EXPECT_EQ(s["floor"], json::parse(R"({"tilt_deg": 0.0, "height_m": 0.0})"));
  EXPECT_EQ(s["objects"]["translation_m"], 0.0);
  EXPECT_EQ(s["objects"]["adds_recall"], 1.0);
  EXPECT_EQ(s["objects"]["recall"], 1.0);
  EXPECT_EQ(s["objects"]["nees_expected"], 6.0);
  EXPECT_NEAR(s["existence"]["ece"], 0.01, 1e-12);
  EXPECT_EQ(s["walls"]["precision"], nullptr);
  EXPECT_EQ(s["change"]["recall"], nullptr);
  EXPECT_EQ(s["stuff"]["id_switches"], 0);
}

TEST_F(Eval, PosesACentimetreOffAreACentimetreOff) {
  json const before = scores();
  for (json& belief : beliefs_) {
    for (json& object : belief["objects"]) {
      object["position"][1] = object["position"][1].get<double>() + 0.01;
    }
  }
  write_beliefs();
  json after = scores();
  EXPECT_NEAR(after["objects"]["translation_m"], 0.01, 1e-9);
  EXPECT_NEAR(after["objects"]["nees"], 1.0, 1e-6) << "one standard deviation";
  after["objects"] = before["objects"];
  EXPECT_EQ(after, before) << "nothing else moves";
}

// Six claims of six degrees of freedom: 36 have the quantiles 21.336 and 54.437.
TEST_F(Eval, TellsWithinWhatAnHonestNeesLies) {
  auto const text = [&] {
    return credo({"eval", run().string(), "--truth", truth().string()}).out;
  };
  json perfect = scores()["objects"];
  EXPECT_NEAR(perfect["nees_low"], 21.336 / 6.0, 1e-3);
  EXPECT_NEAR(perfect["nees_high"], 54.437 / 6.0, 1e-3);
  EXPECT_EQ(perfect["nees_inside"], false);
  EXPECT_NE(
      text().find(
          "NEES 0.00 (expected 6.00, 95 % of independent claims within 3.56 to 9.07: outside, "),
      std::string::npos)
      << text();
  for (json& belief : beliefs_) {
    for (json& object : belief["objects"]) {
      object["position"][1] = object["position"][1].get<double>() + 0.02;
    }
  }
  write_beliefs();
  json const spoilt = scores()["objects"];
  EXPECT_EQ(spoilt["nees_inside"], true);
  ASSERT_EQ(spoilt["claims"].size(), 6U) << "two objects in three frames";
  for (std::size_t i = 0; i < 6; ++i) {
    json const& claim = spoilt["claims"][i];
    EXPECT_EQ(claim["frame"], i / 2);
    EXPECT_EQ(claim["id"], beliefs_[0]["objects"][i % 2]["id"]);
    EXPECT_NEAR(claim["squared_error"], 4.0, 1e-6);
    EXPECT_EQ(claim["degrees_of_freedom"], 6);
  }
  EXPECT_NE(
      text().find(
          "NEES 4.00 (expected 6.00, 95 % of independent claims within 3.56 to 9.07: inside, "),
      std::string::npos)
      << text();
  std::ostringstream repeated;
  repeated << std::fixed << std::setprecision(2) << "as these repeat each other within "
           << spoilt["nees_repeated_low"].get<double>() << " to "
           << spoilt["nees_repeated_high"].get<double>() << ": inside)";
  EXPECT_LT(spoilt["nees_repeated_low"], spoilt["nees_low"]);
  EXPECT_NE(text().find(repeated.str()), std::string::npos) << text();
}

TEST_F(Eval, ErodedLabelsMoveTheSegmentationOnly) {
  json const before = scores();
  fs::path const path = run() / "labels/000001.png";
  Grid<std::uint16_t> labels = read_png16(path);
  Grid<std::uint16_t> const whole = labels;
  double all = 0;
  double left = 0;
  for (int v = 0; v < labels.height(); ++v) {
    for (int u = 0; u < labels.width(); ++u) {
      bool const inner = u > 0 && u + 1 < labels.width() && v > 0 && v + 1 < labels.height() &&
                         whole[{u - 1, v}] == whole[{u, v}] && whole[{u + 1, v}] == whole[{u, v}] &&
                         whole[{u, v - 1}] == whole[{u, v}] && whole[{u, v + 1}] == whole[{u, v}];
      if (is_object(whole[{u, v}])) {
        all += 1;
        left += inner ? 1 : 0;
        labels[{u, v}] = inner ? whole[{u, v}] : kUnassigned;
      }
    }
  }
  write_png16(path, labels);
  json after = scores();
  EXPECT_NEAR(after["segmentation"]["wov"], (2.0 + left / all) / 3.0, 1e-9);
  EXPECT_NEAR(after["segmentation"]["f_os"], (1.0 - left / all) / 3.0, 1e-9);
  EXPECT_EQ(after["segmentation"]["f_us"], 0.0);
  EXPECT_LT(after["segmentation"]["iou"]["object"], 1.0);
  EXPECT_EQ(after["segmentation"]["iou"]["floor"], 1.0);
  after["segmentation"] = before["segmentation"];
  EXPECT_EQ(after, before);
}

TEST_F(Eval, InvertedProbabilitiesInvertTheBrierScore) {
  for (json& belief : beliefs_) {
    for (json& object : belief["objects"]) {
      object["probability"] = 1.0 - object["probability"].get<double>();
    }
  }
  write_beliefs();
  json const s = scores();
  EXPECT_NEAR(s["existence"]["brier"], 0.99 * 0.99, 1e-9);
  EXPECT_NEAR(s["existence"]["ece"], 0.99, 1e-9);
  EXPECT_EQ(s["objects"]["recall"], 0.0);
  EXPECT_EQ(s["objects"]["precision"], nullptr);
  EXPECT_EQ(s["segmentation"]["wov"], 1.0);
}

TEST_F(Eval, ATableForPeopleAndPlots) {
  Ended const ended = credo({"eval", run().string(), "--truth", truth().string(), "--plots",
                             (folder_ / "plots").string()});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_THAT(ended.out, HasSubstr("WOv 100.0 %"));
  EXPECT_THAT(ended.out, HasSubstr("ECE 0.0100, Brier 0.0001 over 6 claims"));
  EXPECT_THAT(read_text(folder_ / "plots/reliability.svg"), StartsWith("<svg"));
  EXPECT_THAT(read_text(folder_ / "plots/frames.svg"), HasSubstr("weighted overlap"));
}

TEST_F(Eval, WithoutLabelImagesTheRestIsScored) {
  fs::remove_all(run() / "labels");
  Ended const ended = credo({"eval", run().string(), "--truth", truth().string(), "--json"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.err, HasSubstr("no label images (--dump labels)"));
  json const s = json::parse(ended.out);
  EXPECT_EQ(s["segmentation"]["wov"], nullptr);
  EXPECT_EQ(s["stuff"]["id_switches"], nullptr);
  EXPECT_EQ(s["objects"]["recall"], 1.0);
}

TEST_F(Eval, ATruthOfAnotherLengthClockOrPlaceDoesNotFit) {
  std::string const does_not_fit = truth().string() + ": the truth does not fit the run: ";
  beliefs_.back()["frame"] = 7;
  write_beliefs();
  EXPECT_EQ(refusal(), "credo: " + does_not_fit + "it has no frame 7\n");
  beliefs_.back()["frame"] = 2;
  beliefs_.back()["stamp_ns"] = 5;
  write_beliefs();
  EXPECT_THAT(refusal(), HasSubstr(does_not_fit + "frame 2 is at 2000000000 ns, the run's at 5"));
  beliefs_.back()["stamp_ns"] = 2000000000;
  beliefs_.front()["T_world_camera"][3] = 4.0;
  write_beliefs();
  EXPECT_THAT(refusal(), HasSubstr(does_not_fit + "in frame 0 the cameras are 4.00 m and 0 degr"));
}

TEST_F(Eval, ImagesOfAnotherSizeDoNotFit) {
  write_png16(run() / "labels/000001.png", Grid<std::uint16_t>(320, 240));
  EXPECT_THAT(refusal(), HasSubstr("its frame 1 has 640 x 480 pixels, the run's 320 x 240"));
}

TEST_F(Eval, WhatIsMissingIsNamed) {
  fs::remove(run() / "labels/000001.png");
  EXPECT_THAT(refusal(), HasSubstr("labels/000001.png"));
  fs::remove(run() / "belief.jsonl");
  EXPECT_THAT(refusal(), HasSubstr("no run: it has no belief.jsonl"));
}

TEST_F(Eval, AFolderWithoutTruthIsTold) {
  fs::remove(truth() / "truth.jsonl");
  EXPECT_THAT(refusal(), HasSubstr("no truth: it has neither a truth.jsonl"));
  fs::remove_all(truth());
  EXPECT_THAT(refusal(), HasSubstr("no such folder of a truth"));
}

/// A scene with a model that the project does not have, beside it.
std::string scene_with_a_pyramid(TempFolder const& folder) {
  write_text(folder / "pyramid.ply",
             "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
             "property float z\nelement face 6\nproperty list uchar int vertex_indices\n"
             "end_header\n-0.2 -0.2 0\n0.2 -0.2 0\n0.2 0.2 0\n-0.2 0.2 0\n0 0 0.5\n"
             "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n3 0 2 1\n3 0 3 2\n");
  write_text(folder / "pyramid.yaml",
             "name: pyramid\nmesh: pyramid.ply\nsymmetry: [{rpy_deg: [0, 0, 90]}, "
             "{rpy_deg: [0, 0, 180]}, {rpy_deg: [0, 0, 270]}]\n");
  write_text(folder / "scene.yaml",
             "things:\n"
             "  - {name: floor, kind: floor, shape: box, size_m: [9, 9, 0.1], position_m: [0, 0, "
             "-0.1]}\n"
             "  - {name: one, kind: object, model: pyramid, position_m: [2, 0, 0]}\n"
             "camera:\n  path:\n"
             "    - {time_s: 0, position_m: [0, 0, 1.2], look_at_m: [2, 0, 0]}\n");
  write_text(folder / "prior.yaml",
             "objects:\n  - {id: p, model: pyramid, position: [2.03, 0, 0], rpy_deg: [0, 0, 90], "
             "sigma_position_m: 0.05, sigma_rotation_rad: 0.05}\n");
  return (folder / "scene.yaml").string();
}

TEST(EvalModels, ComeAlongWithTheTruth) {
  TempFolder const folder;
  std::string const scene = scene_with_a_pyramid(folder);
  Ended const simulated = credo({"simulate", scene, "--out", (folder / "truth").string()});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  Ended const run =
      credo({"run", "--source", "sim:" + scene, "--prior", (folder / "prior.yaml").string(),
             "--no-dds", "--dump", "labels", "--out", (folder / "run").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  fs::remove(folder / "pyramid.yaml");
  fs::remove(folder / "pyramid.ply");
  Ended const ended =
      credo({"eval", (folder / "run").string(), "--truth", (folder / "truth").string(), "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  json const s = json::parse(ended.out);
  EXPECT_NEAR(s["objects"]["translation_m"], 0.03, 1e-9) << "nobody looked: as it was told";
  EXPECT_NEAR(s["objects"]["rotation_deg"], 0.0, 1e-6) << "a quarter turn is no error of it";
  EXPECT_EQ(s["objects"]["adds_recall"], 1.0);
}

TEST_F(Eval, ACameraThatIsNowhereIsRefused) {
  beliefs_[1]["T_world_camera"][0] = 2.0;
  write_beliefs();
  EXPECT_THAT(refusal(), HasSubstr("belief.jsonl: frame 1: T_world_camera is no pose"));
}

TEST(EvalRecordings, LabelFieldsOfTheTableTopsAreATruth) {
  CREDO_REQUIRE_RECORDING("osd");
  fs::path const osd = recordings() / "osd";
  TempFolder const folder;
  Ended const run = credo({"run", "--source", "dataset:" + osd.string(), "--no-dds", "--frames",
                           "3", "--dump", "labels", "--out", (folder / "run").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  Ended const ended = credo({"eval", (folder / "run").string(), "--truth", osd.string(), "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  json const s = json::parse(ended.out);
  EXPECT_EQ(s["frames"], 3);
  EXPECT_GT(s["segmentation"]["wov"], 0.5);
  EXPECT_GT(s["segmentation"]["merged"]["wov"], 0.5);
  EXPECT_EQ(s["segmentation"]["iou"], nullptr);
  EXPECT_EQ(s["existence"]["ece"], nullptr);
}

}  // namespace
}  // namespace credo::test
