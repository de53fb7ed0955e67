// The scenes of the thesis' chapter 3, simulated with a Kinect's noise: what it says of each is
// asserted against the truth of every pixel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/label.hpp"
#include "end_to_end/program.hpp"
#include "io/image.hpp"
#include "support/paths.hpp"

namespace credo::test {
namespace {

using nlohmann::json;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class ThesisScene : public ::testing::Test {
protected:
  /// Runs a scene of one frame; `prior` is a name in scenes/priors, or empty.
  void run(std::string const& scene, std::string const& prior, std::string const& bias = "0") {
    std::vector<std::string> arguments = {"run",      "--source", "sim:" + scene,
                                          "--no-dds", "--out",    (folder_ / "out").string(),
                                          "--dump",   "labels"};
    if (!prior.empty()) {
      std::vector<std::string> const known = {
          "--prior", (source_folder() / "scenes/priors" / (prior + ".yaml")).string(),
          "--set",   "detector.kind=sim",
          "--set",   "detector.sim.sigma_position_m=0",
          "--set",   "detector.sim.sigma_rotation_rad=0",
          "--set",   "detector.sim.bias_position_m=[0, 0, " + bias + "]"};
      arguments.insert(arguments.end(), known.begin(), known.end());
    }
    Ended const ended = credo(arguments);
    ASSERT_EQ(ended.code, 0) << ended.err;
    Ended const simulated = credo({"simulate", scene, "--out", (folder_ / "truth").string()});
    ASSERT_EQ(simulated.code, 0) << simulated.err;
    belief_ = json::parse(read_lines(folder_ / "out/belief.jsonl").at(0));
    truth_ = json::parse(read_lines(folder_ / "truth/truth.jsonl").at(0));
    labels_ = read_png16(folder_ / "out/labels/000000.png");
    true_labels_ = read_png16(folder_ / "truth/truth/000000.png");
  }

  /// Of the true label `code` with the label here that covers most of it, among those of which
  /// `wanted` is true.
  template <typename Wanted>
  double best_iou(int code, Wanted const& wanted) const {
    std::map<int, std::pair<double, double>> sizes;  // label: both, all of it
    double all = 0;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      bool const is = true_labels_[i] == code;
      all += is ? 1 : 0;
      sizes[labels_[i]].first += is ? 1 : 0;
      sizes[labels_[i]].second += 1;
    }
    double best = 0;
    for (auto const& [label, size] : sizes) {
      if (wanted(static_cast<LabelCode>(label))) {
        best = std::max(best, size.first / (all + size.second - size.first));
      }
    }
    return best;
  }
  [[nodiscard]] double floor_iou() const {
    return best_iou(kFloor, [](LabelCode c) { return c == kFloor; });
  }
  [[nodiscard]] double object_iou(LabelCode code) const {
    return best_iou(code, [&](LabelCode c) { return c == code; });
  }
  [[nodiscard]] double stuff_iou(std::string const& id) const {
    for (json const& thing : truth_["stuff"]) {
      if (thing["id"] == id) {
        return best_iou(thing["label"], [](LabelCode c) { return is_stuff(c); });
      }
    }
    return -1.0;
  }
  [[nodiscard]] int stuff_pixels(int least) const {
    int count = 0;
    for (json const& thing : belief_["stuff"]) {
      count += thing["points"] >= least ? 1 : 0;
    }
    return count;
  }

  TempFolder folder_;
  json belief_;
  json truth_;
  Grid<std::uint16_t> labels_;
  Grid<std::uint16_t> true_labels_;
};

TEST_F(ThesisScene, Chapter3Scene1IsAWallAndTheFloor) {
  run("thesis-3.4.1", "");
  EXPECT_GT(floor_iou(), 0.98);
  EXPECT_THAT(belief_["walls"], SizeIs(1));
  EXPECT_GT(best_iou(kFirstWall, [](LabelCode c) { return is_wall(c); }), 0.98);
  EXPECT_THAT(belief_["stuff"], IsEmpty());
}

// "The yellow and green points correspond to the pillar on the glass wall": nothing else is stuff.
TEST_F(ThesisScene, Chapter3Scene2LeavesThePillarsOfTheGlassWall) {
  run("thesis-3.4.2", "thesis-table-and-box");
  EXPECT_GT(floor_iou(), 0.95);
  EXPECT_THAT(belief_["walls"], IsEmpty()) << "glass returns nothing";
  EXPECT_GT(object_iou(kFirstObject), 0.9) << "table";
  EXPECT_GT(object_iou(kFirstObject + 1), 0.9) << "box";
  EXPECT_GT(stuff_iou("left pillar"), 0.7) << "its narrow side may be a cluster of its own";
  EXPECT_GT(stuff_iou("right pillar"), 0.7);
  EXPECT_LE(stuff_pixels(100), 4) << "two sides of two pillars";
}

TEST_F(ThesisScene, Chapter3Scene2WithoutTheBoxInMindTheBoxIsStuff) {
  run("thesis-3.4.2", "thesis-table");
  EXPECT_GT(object_iou(kFirstObject), 0.9) << "table";
  // The truth still calls the box an object.
  EXPECT_GT(best_iou(kFirstObject + 1, [](LabelCode c) { return is_stuff(c); }), 0.85);
  EXPECT_GT(stuff_iou("left pillar"), 0.7);
  EXPECT_GT(stuff_iou("right pillar"), 0.7);
}

TEST_F(ThesisScene, Chapter3Scene3FindsTheBottleThatNobodyToldOf) {
  run("thesis-3.4.3", "thesis-table-and-box");
  EXPECT_GT(object_iou(kFirstObject), 0.9) << "table";
  EXPECT_GT(object_iou(kFirstObject + 1), 0.9) << "box";
  EXPECT_GT(stuff_iou("bottle"), 0.85);
  EXPECT_GT(stuff_iou("left pillar"), 0.7);
}

TEST_F(ThesisScene, Chapter3Scene4HasTheBoxAsStuffBeforeTheWall) {
  run("thesis-3.4.4", "thesis-table");
  EXPECT_THAT(belief_["walls"], SizeIs(1));
  EXPECT_GT(best_iou(kFirstWall, [](LabelCode c) { return is_wall(c); }), 0.97);
  EXPECT_GT(object_iou(kFirstObject), 0.9) << "table";
  EXPECT_GT(stuff_iou("box"), 0.85);
  EXPECT_EQ(stuff_pixels(100), 1) << "nothing but the box";
}

// "The purple points correspond to points that were not aligned properly with the detected table."
TEST_F(ThesisScene, Chapter3Scene4WithATableTooLowLeavesItsTop) {
  run("thesis-3.4.4", "thesis-table", "-0.04");
  EXPECT_GE(stuff_pixels(100), 1);
  int left_over = 0;
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    left_over += true_labels_[i] == kFirstObject && is_stuff(labels_[i]) ? 1 : 0;
  }
  EXPECT_GT(left_over, 3000) << "pixels of the table that are stuff";
}

}  // namespace
}  // namespace credo::test
