// What people hide for a while, and what trades places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "end_to_end/known_scene.hpp"
#include "sim/scene_time.hpp"
#include "sim/truth.hpp"

namespace credo::test {
namespace {

/// The scene in a quarter of the pixels and four frames a second: the swap is seen in frame 8, the
/// person walks from frame 20 to 32.
class SwapAndOcclude : public ::testing::Test {
protected:
  void SetUp() override {
    known_ = known_scene("swap-and-occlude");
    known_.scene.camera = smaller(known_.scene.camera, 2);
    known_.scene.camera.frames_per_s = 4;
    beliefs_ = run_scene(known_, exact_detector());
    ASSERT_EQ(beliefs_.size(), 40U);
  }

  /// Of what is believed to be where the bottle stands.
  [[nodiscard]] double bottle(std::size_t frame) const {
    double best = 0.0;
    for (StuffBelief const& stuff : beliefs_[frame]->stuff) {
      Eigen::Vector3d const centre = stuff.latest().centroid_world.cast<double>();
      if ((centre - Eigen::Vector3d(2.1, 0, 0.85)).norm() < 0.1) {
        best = std::max(best, probability_of(stuff.log_odds));
      }
    }
    return best;
  }
  /// The truth of the bottle, which is the scene's only stuff that stands.
  [[nodiscard]] double bottle_in_sight(std::size_t frame) const {
    return truth_of(known_.scene, FrameIndex{static_cast<std::int64_t>(frame)})
        .stuff[0]
        .visible_fraction;
  }

  KnownScene known_;
  std::vector<BeliefPtr> beliefs_;
};

TEST_F(SwapAndOcclude, WhatAPersonHidesStaysAndWhatWasSwappedDoesNot) {
  std::size_t hidden = 0;
  for (std::size_t i = 2; i < beliefs_.size(); ++i) {
    EXPECT_GT(bottle(i), 0.5) << i;
    EXPECT_GT(probability_of(beliefs_[i]->objects[0].log_odds), 0.9) << "table, " << i;
    hidden += bottle_in_sight(i) < 0.05 ? 1 : 0;
  }
  EXPECT_GE(hidden, 1U) << "or nothing was tried";
  EXPECT_GT(bottle(39), 0.98) << "seen again";
  // What was swapped is believed where it stood until then, and no longer.
  for (std::size_t object : {std::size_t{1}, std::size_t{2}}) {
    EXPECT_GT(probability_of(beliefs_[7]->objects[object].log_odds), 0.9);
    ObjectBelief const& last = beliefs_[39]->objects[object];
    Eigen::Vector3d const old = beliefs_[7]->objects[object].pose_world.mean.translation();
    bool const still_there = (last.pose_world.mean.translation() - old).norm() < 0.2 &&
                             probability_of(last.log_odds) > 0.5;
    EXPECT_FALSE(still_there) << last.id;
  }
}

}  // namespace
}  // namespace credo::test
