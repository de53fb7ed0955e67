// What the belief makes of noisy detections of a simulated box, against the truth.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "end_to_end/known_scene.hpp"

namespace credo::test {
namespace {

constexpr int kRuns = 200;

/// These tests read poses, not labels.
KnownScene small_box_on_table() {
  KnownScene known = known_scene("box-on-table");
  known.scene.camera = smaller(known.scene.camera, 8);
  return known;
}

ObjectBelief const& object_of(BeliefState const& belief, std::string const& id) {
  return *std::ranges::find(belief.objects, id, &ObjectBelief::id);
}
ObjectBelief& object_of(BeliefState& belief, std::string const& id) {
  return *std::ranges::find(belief.objects, id, &ObjectBelief::id);
}

/// What a frame says of one object over all runs.
struct Look {
  double nees_sum = 0.0;
  double squared_error_sum_m2 = 0.0;
  double variance_sum_m2 = 0.0;
};

/// The prior's mean is drawn from its own distribution around the truth, as the filter assumes.
void draw_prior(ObjectBelief& object, Se3 const& truth, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector6d unit;
  for (double& value : unit) {
    value = normal(random);
  }
  Eigen::LLT<Matrix6d> const root(object.pose_world.covariance);
  object.pose_world.mean = boxplus(truth, root.matrixL() * unit);
}

std::vector<Look> looks_of_many_runs() {
  KnownScene known = small_box_on_table();
  Se3 const truth = true_pose(known.scene, 0, "box");
  SimDetectorConfig detector;
  detector.sigma_position_m = 0.02;
  detector.sigma_rotation_rad = 0.05;
  detector.miss_probability = 0.1;
  detector.false_alarms_per_frame = 0.2;
  std::vector<Look> looks;
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run));
    draw_prior(object_of(known.prior, "box_1"), truth, random);
    detector.seed = run;
    std::vector<BeliefPtr> const beliefs = run_scene(known, detector);
    looks.resize(beliefs.size());
    for (std::size_t i = 0; i < beliefs.size(); ++i) {
      PoseDistribution const& pose = object_of(*beliefs[i], "box_1").pose_world;
      Vector6d const error = boxminus(truth, pose.mean);
      looks[i].nees_sum += error.dot(pose.covariance.ldlt().solve(error));
      looks[i].squared_error_sum_m2 += error.head<3>().squaredNorm();
      looks[i].variance_sum_m2 += pose.covariance.topLeftCorner<3, 3>().trace();
    }
  }
  return looks;
}

// The sum of the squared normalised errors of n runs follows a chi-square distribution of 6 n
// degrees of freedom: mean 6, standard deviation of the mean sqrt(2 * 6 / n) (Bar-Shalom, Li and
// Kirubarajan 2001, 5.4.2).
TEST(ObjectFilter, ErrorAndCovarianceShrinkTogether) {
  std::vector<Look> const looks = looks_of_many_runs();
  ASSERT_EQ(looks.size(), 9U);
  double const bound = 1.96 * std::sqrt(2.0 * 6.0 / kRuns);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_NEAR(looks[i].nees_sum / kRuns, 6.0, bound) << "frame " << i;
    RecordProperty("nees_permille_" + std::to_string(i),
                   static_cast<int>(1000 * looks[i].nees_sum / kRuns));
    // Both are sums of 3 x 200 squares: 15 % is more than two and a half standard deviations.
    EXPECT_NEAR(looks[i].squared_error_sum_m2 / looks[i].variance_sum_m2, 1.0, 0.15)
        << "frame " << i;
    if (i > 0) {
      EXPECT_LT(looks[i].variance_sum_m2, looks[i - 1].variance_sum_m2) << "frame " << i;
    }
  }
  EXPECT_LT(looks.back().squared_error_sum_m2, 0.3 * looks.front().squared_error_sum_m2);
}

// Seen from everywhere, a bottle tells how it is turned no better than from nowhere.
TEST(ObjectFilter, ACylindersYawStaysUncertainForEver) {
  KnownScene known = small_box_on_table();
  known.models["bottle"] = project_model("bottle");
  object_of(known.prior, "box_1").type = "bottle";
  SceneThing& thing =
      known.scene.things.at(static_cast<std::size_t>(position_of(known.scene, "box")));
  thing.type = "bottle";
  thing.shape = SceneShape::kCylinder;
  thing.size_m = {0.045, 0.26};
  Matrix6d const before = object_of(known.prior, "box_1").pose_world.covariance;
  for (int seed = 1; seed <= 5; ++seed) {
    SimDetectorConfig detector;
    detector.seed = seed;
    std::vector<BeliefPtr> const beliefs = run_scene(known, detector);
    ASSERT_EQ(beliefs.size(), 9U);
    for (BeliefPtr const& belief : beliefs) {
      ObjectBelief const& bottle = object_of(*belief, "box_1");
      ASSERT_EQ(bottle.evidence, Evidence::kSeen);
      Eigen::Vector3d const axis = bottle.pose_world.mean.rotation() * Eigen::Vector3d::UnitZ();
      Matrix6d const information = bottle.pose_world.covariance.inverse();
      double const about_axis = axis.dot(information.bottomRightCorner<3, 3>() * axis);
      EXPECT_NEAR(1.0 / about_axis, before(5, 5), 1e-9);
      EXPECT_LT((bottle.pose_world.covariance.topLeftCorner<3, 3>().trace()), 2e-4);
      EXPECT_LT(bottle.pose_world.covariance(3, 3), 0.1 * before(3, 3)) << "it leans no way";
    }
  }
}

// Nudged by 4 cm, within what the prior lets be, after ten seconds of looking at it from one place:
// at first the gate does not believe it, and then it is found where it is.
TEST(ObjectFilter, ANudgedBoxIsFoundAgain) {
  KnownScene known = small_box_on_table();
  known.scene.camera.frames_per_s = 30;
  known.scene.camera.path = {{0, {0, 0, 1.4}, {2, 0, 0.6}}, {20, {0, 0, 1.4}, {2, 0, 0.6}}};
  known.scene.events = {{10.0, "box", SceneChange::kMoved, {}, {2.0, 0.14, 0.72}, {}}};
  std::vector<BeliefPtr> const beliefs = run_scene(known, {});
  ASSERT_EQ(beliefs.size(), 601U);
  auto const off_m = [&](std::size_t frame) {
    return (object_of(*beliefs[frame], "box_1").pose_world.mean.translation() -
            true_pose(known.scene, static_cast<std::int64_t>(frame), "box").translation())
        .norm();
  };
  EXPECT_LT(off_m(299), 0.005);
  EXPECT_GT(off_m(300), 0.035);
  EXPECT_LT(off_m(390), 0.01) << "three seconds later";
  EXPECT_LT(off_m(600), 0.005);
  EXPECT_GT(probability_of(object_of(*beliefs[600], "box_1").log_odds), 0.98);
}

}  // namespace
}  // namespace credo::test
