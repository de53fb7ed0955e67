// Recorded detections over real frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "end_to_end/contract.hpp"
#include "end_to_end/program.hpp"
#include "io/image.hpp"
#include "support/linemod_cat.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A line of recorded detections that sees the cat there.
json sight_of(Se3 const& T_camera_cat) {
  Eigen::Quaterniond const& q = T_camera_cat.rotation();
  Eigen::Vector3d const& p = T_camera_cat.translation();
  json covariance = json::array();
  for (int i = 0; i < 36; ++i) {
    covariance.push_back(i % 7 != 0 ? 0.0 : (i < 18 ? 1e-5 : 1e-3));
  }
  json const cat = {{"type", "cat"},
                    {"position", {p.x(), p.y(), p.z()}},
                    {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}},
                    {"covariance", covariance},
                    {"score", 0.9}};
  return {{"frame", 0}, {"detections", {cat}}};
}

class LinemodCat : public ::testing::Test {
protected:
  static fs::path mesh() { return recordings() / "objects/lmo/obj_000006.ply"; }

  void write_inputs() {
    write_text(folder_ / "cat.yaml", "name: cat\nmesh: " + mesh().string() + "\nunit: mm\n");
    write_text(
        folder_ / "prior.yaml",
        "frame: camera\nobjects:\n  - {id: cat_1, model: cat, position: [0.09, -0.14, 1.03], "
        "orientation_xyzw: [0.71, 0.61, -0.29, 0.21], sigma_position_m: 0.05, "
        "sigma_rotation_rad: 0.2}\n");
    write_text(folder_ / "seen.jsonl", sight_of(true_cat_pose()).dump() + "\n");
  }

  TempFolder folder_;
};

TEST_F(LinemodCat, IsLabelledWhereItWasSeen) {
  CREDO_REQUIRE_RECORDING("frames/linemod-cat");
  write_inputs();
  fs::path const out = folder_ / "out";
  Ended const ended = credo(
      {"run", "--source", "dataset:" + (recordings() / "frames/linemod-cat").string(), "--prior",
       (folder_ / "prior.yaml").string(), "--out", out.string(), "--dump", "labels", "--set",
       "detector.kind=recorded", "--set", "detector.file=" + (folder_ / "seen.jsonl").string()});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("objects: 1 detections taken, 0 refused"));
  EXPECT_THAT(contract_faults(out), IsEmpty());
  json const cat = json::parse(read_lines(out / "belief.jsonl").at(0))["objects"][0];
  EXPECT_EQ(cat["evidence"], "seen");
  EXPECT_EQ(cat["label"], 3000);
  // The cat is 6.7 x 12.8 x 11.7 cm, 1.05 m away: its centre projects to (364, 156), and the ears
  // and paws end within 50 pixels of it. The frame shows 2231 pixels of it.
  Grid<std::uint16_t> const labels = read_png16(out / "labels/000000.png");
  int inside = 0;
  int outside = 0;
  for (int v = 0; v < labels.height(); ++v) {
    for (int u = 0; u < labels.width(); ++u) {
      if (labels[Pixel{u, v}] == 3000) {
        ++(std::hypot(u - 364, v - 156) < 50 ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, 1800);
  EXPECT_LT(inside, 2700);
  EXPECT_EQ(outside, 0);
}

}  // namespace
}  // namespace credo::test
