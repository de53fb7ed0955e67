#include "graph/stages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace credo {
namespace {

using Eigen::Vector3d;
using testing::SizeIs;

/// Remembers what it was asked, and finds the first thing asked for `aside_m` to the camera's right
/// of where it is expected, if told so.
class FakeDetector : public Detector {
public:
  explicit FakeDetector(std::vector<DetectionRequest>& asked) : asked_(asked) {}

  std::vector<Detection> detect(Frame const&,
                                std::vector<DetectionRequest> const& requests) override {
    asked_.insert(asked_.end(), requests.begin(), requests.end());
    if (is_away) {
      throw NobodyLooked("nobody is there");
    }
    if (std::isnan(aside_m)) {
      return {};
    }
    PoseDistribution pose = requests.at(0).expected_camera;
    pose.mean = Se3(pose.mean.rotation(), pose.mean.translation() + Vector3d(aside_m, 0, 0));
    return {{requests[0].type, pose, 1.0, 1.0}};
  }

  double aside_m = kNaN;
  bool is_away = false;

private:
  std::vector<DetectionRequest>& asked_;
};

/// One box, turned, its deviations different along each axis.
Prior prior_in(PriorFrame frame) {
  ObjectBelief box;
  box.id = "box_1";
  box.type = "box";
  box.log_odds = 1.0;
  box.pose_world.mean = Se3(so3_exp({0.3, -0.4, 0.5}), {0.1, -0.2, 1.5});
  box.pose_world.covariance = Vector6d(0.01, 0.02, 0.03, 0.04, 0.05, 0.06).asDiagonal();
  return {frame, {box}};
}

/// Nothing to see; each frame's camera stands elsewhere, turned.
Frame frame_of(std::int64_t index) {
  Frame frame;
  frame.index = FrameIndex{index};
  // Far enough apart that each look is news.
  frame.stamp_ns = index * 60'000'000'000;
  frame.cloud_camera = OrganizedCloud(8, 8);
  auto const step = static_cast<double>(index);
  frame.T_source_camera =
      Se3(so3_exp({0.2, 0.3 * step, -0.1}), {1.0 + step, 2.0 - 3.0 * step, 0.5 * step});
  return frame;
}

class StagesTest : public testing::Test {
protected:
  StagesTest() {
    config_.capture.independent_frames = true;
    // The world is the source's: what a camera sees then depends on its pose alone.
    config_.pose.level = LevelMode::kOff;
    auto known = std::make_shared<KnownObjects>();
    known->models = {{"box", {"box", {std::vector<Solid>{box_on_base({0.1, 0.2, 0.3})}}, {}}}};
    known->shapes = shapes_of(known->models);
    known->surfaces = known_surfaces(known->models);
    auto detector = std::make_unique<FakeDetector>(asked_);
    detector_ = detector.get();
    known->detector = std::move(detector);
    known_ = std::move(known);
  }

  /// The beliefs after each frame, each segmented and fused with the one before.
  std::vector<BeliefState> run(Prior const& prior, std::int64_t frames,
                               WorldLevel const& level = {}) {
    Stages const stages = make_stages(config_, level, prior, known_);
    BeliefState belief = prior_belief(prior, frame_of(0).T_source_camera);
    std::vector<BeliefState> beliefs;
    for (std::int64_t i = 0; i < frames; ++i) {
      belief = stages.fusion(belief, segment(stages, frame_of(i), belief));
      beliefs.push_back(belief);
    }
    return beliefs;
  }

  PipelineConfig config_;
  std::vector<DetectionRequest> asked_;
  FakeDetector* detector_ = nullptr;
  std::shared_ptr<KnownObjects const> known_;
};

void expect_pose(PoseDistribution const& pose, PoseDistribution const& expected) {
  EXPECT_TRUE(pose.mean.matrix().isApprox(expected.mean.matrix(), 1e-9)) << pose.mean.matrix();
  EXPECT_LT((pose.covariance - expected.covariance).norm(), 1e-9) << pose.covariance;
}

TEST_F(StagesTest, IndependentFramesBeginWithAPriorInTheirOwnCamera) {
  Prior const prior = prior_in(PriorFrame::kCamera);
  std::vector<BeliefState> const beliefs = run(prior, 3);
  ASSERT_THAT(asked_, SizeIs(3));
  PoseDistribution const& told = prior.objects[0].pose_world;
  for (std::int64_t i = 0; i < 3; ++i) {
    auto const n = static_cast<std::size_t>(i);
    expect_pose(asked_[n].expected_camera, told);
    ASSERT_THAT(beliefs[n].objects, SizeIs(1));
    expect_pose(beliefs[n].objects[0].pose_world, transformed(frame_of(i).T_source_camera, told));
  }
}

TEST_F(StagesTest, IndependentFramesBeginWithAPriorInTheWorldWhereverTheCameraIs) {
  Prior const prior = prior_in(PriorFrame::kWorld);
  std::vector<BeliefState> const beliefs = run(prior, 3);
  ASSERT_THAT(asked_, SizeIs(3));
  PoseDistribution const& told = prior.objects[0].pose_world;
  for (std::int64_t i = 0; i < 3; ++i) {
    auto const n = static_cast<std::size_t>(i);
    expect_pose(asked_[n].expected_camera,
                transformed(frame_of(i).T_source_camera.inverse(), told));
    expect_pose(beliefs[n].objects.at(0).pose_world, told);
  }
}

TEST_F(StagesTest, NothingLearntInAnIndependentFrameIsLeftInTheNext) {
  Prior const prior = prior_in(PriorFrame::kCamera);
  detector_->aside_m = 0.1;
  std::vector<BeliefState> const beliefs = run(prior, 3);
  for (std::int64_t i = 0; i < 3; ++i) {
    ObjectBelief const& object = beliefs.at(static_cast<std::size_t>(i)).objects.at(0);
    EXPECT_EQ(object.evidence, Evidence::kSeen);
    EXPECT_NEAR(object.log_odds, beliefs[0].objects[0].log_odds, 1e-9);
    Vector3d const moved =
        frame_of(i).T_source_camera.inverse() * object.pose_world.mean.translation();
    Vector3d const halfway = prior.objects[0].pose_world.mean.translation() + Vector3d(0.05, 0, 0);
    EXPECT_LT((moved - halfway).norm(), 1e-9) << "detection and prior are equally sure";
    expect_pose(asked_[static_cast<std::size_t>(i)].expected_camera, prior.objects[0].pose_world);
  }
}

TEST_F(StagesTest, APriorInTheCameraFollowsEachFramesOwnLevel) {
  config_.pose.level = LevelMode::kAuto;
  config_.pose.camera_height_m = 1.5;
  Prior const prior = prior_in(PriorFrame::kCamera);
  for (BeliefState const& belief : run(prior, 2)) {
    EXPECT_NEAR(belief.T_world_camera.translation().z(), 1.5, 1e-9);
    expect_pose(belief.objects.at(0).pose_world,
                transformed(belief.T_world_camera, prior.objects[0].pose_world));
  }
  ASSERT_THAT(asked_, SizeIs(2));
  expect_pose(asked_[1].expected_camera, prior.objects[0].pose_world);
}

TEST_F(StagesTest, FramesThatBelongTogetherHaveOnePriorInTheWorld) {
  config_.capture.independent_frames = false;
  Prior const prior = prior_in(PriorFrame::kCamera);
  run(prior, 3, {Se3(), true, ""});
  ASSERT_THAT(asked_, SizeIs(3));
  // Placed once, at the first camera; later ones see it from where they stand.
  PoseDistribution const in_world =
      transformed(frame_of(0).T_source_camera, prior.objects[0].pose_world);
  expect_pose(asked_[2].expected_camera,
              transformed(frame_of(2).T_source_camera.inverse(), in_world));
}

TEST_F(StagesTest, AFrameIsSegmentedWithTheCorrectionThatIsBelieved) {
  config_.capture.independent_frames = false;
  config_.fusion.drift.enabled = true;
  Prior const prior = prior_in(PriorFrame::kWorld);
  Se3 const level(so3_exp({0.1, -0.2, 0.05}), {0.0, 0.0, 1.2});
  Stages const stages = make_stages(config_, {level, true, ""}, prior, known_);
  BeliefState belief = prior_belief(prior, level * frame_of(0).T_source_camera);
  belief.T_world_told = Se3(so3_exp({0.01, 0.02, 0.03}), {0.03, -0.02, 0.01});
  Se3 const camera = belief.T_world_told * level * frame_of(1).T_source_camera;
  Segmentation const segmentation = segment(stages, frame_of(1), belief);
  EXPECT_TRUE(segmentation.T_world_camera.matrix().isApprox(camera.matrix(), 1e-12));
  EXPECT_TRUE(segmentation.T_world_told.matrix().isApprox(belief.T_world_told.matrix(), 1e-12));
  ASSERT_THAT(asked_, SizeIs(1));
  expect_pose(asked_[0].expected_camera,
              transformed(camera.inverse(), prior.objects[0].pose_world));
  // A frame that shows nothing leaves it; another, of the belief that it is fused into, counts.
  BeliefState const after = stages.fusion(belief, segmentation);
  EXPECT_TRUE(after.T_world_camera.matrix().isApprox(camera.matrix(), 1e-12));
  belief.T_world_told = Se3();
  BeliefState const told = stages.fusion(belief, segmentation);
  EXPECT_TRUE(
      told.T_world_camera.matrix().isApprox((level * frame_of(1).T_source_camera).matrix(), 1e-12));
  EXPECT_TRUE(told.T_world_told.matrix().isIdentity(1e-12));
}

// That is not the same as that it looked and found nothing, which counts against what is in view.
TEST_F(StagesTest, WhereNobodyLookedNothingIsLearntOfObjects) {
  config_.capture.independent_frames = false;
  config_.fusion.visibility = false;
  // Each look is news, and the box in the middle of the picture.
  Prior prior = prior_in(PriorFrame::kCamera);
  prior.objects[0].pose_world.mean = Se3(Eigen::Quaterniond::Identity(), {0, 0, 1.5});
  double const log_odds = prior.objects[0].log_odds;
  Stages const stages = make_stages(config_, {Se3(), true, ""}, prior, known_);
  Frame const frame = frame_of(0);
  BeliefState const before = prior_belief(prior, frame.T_source_camera);

  detector_->is_away = true;
  Segmentation const blind = segment(stages, frame, before);
  EXPECT_THAT(asked_, SizeIs(1));
  EXPECT_FALSE(blind.objects_looked_for);
  BeliefState const after = stages.fusion(before, blind);
  EXPECT_EQ(after.objects.at(0).log_odds, log_odds);
  EXPECT_EQ(after.objects.at(0).evidence, Evidence::kNotSeen);

  detector_->is_away = false;
  Segmentation const looked = segment(stages, frame, before);
  EXPECT_TRUE(looked.objects_looked_for);
  EXPECT_LT(stages.fusion(before, looked).objects.at(0).log_odds, log_odds);
}

struct Asked {
  bool visibility;
  bool drift;
};

class SightTest : public StagesTest, public testing::WithParamInterface<Asked> {};

TEST_P(SightTest, IsMadeForWhoAsks) {
  config_.fusion.visibility = GetParam().visibility;
  config_.fusion.drift.enabled = GetParam().drift;
  Stages const stages = make_stages(config_, {Se3(), true, ""}, {}, known_);
  Segmentation const segmentation = segment(stages, frame_of(0), {});
  EXPECT_EQ(segmentation.sight.depth_m.empty(), !GetParam().visibility && !GetParam().drift);
  EXPECT_EQ(segmentation.sight.normals_camera.empty(), !GetParam().drift);
}

INSTANTIATE_TEST_SUITE_P(Of, SightTest,
                         testing::Values(Asked{false, false}, Asked{true, false},
                                         Asked{false, true}, Asked{true, true}));

}  // namespace
}  // namespace credo
