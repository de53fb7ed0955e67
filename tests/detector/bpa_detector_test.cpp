#include "detector/bpa_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

ObjectModels models() {
  return {{"bracket", bracket()}, {"can", can(0.04, 0.12)}};
}

BpaConfig config_of(ObjectSearch search, int every = 1, int lag = 3) {
  BpaConfig config;
  config.search = search;
  config.global_every_frames = every;
  config.global_lag_frames = lag;
  return config;
}

PoseDistribution around(Se3 const& mean, double sigma_m, double sigma_rad) {
  PoseDistribution pose;
  pose.mean = mean;
  pose.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  return pose;
}
DetectionRequest request(Se3 const& expected, std::string const& type = "bracket") {
  return {type + "_1", type, around(expected, 0.012, 0.08)};
}
/// Expected nowhere in particular, and so not where it is.
DetectionRequest vague_request(Se3 const& T_camera_world) {
  return {"bracket_1", "bracket", around(T_camera_world * placed_at({0.4, 0.2, 0}), 1.0, 2.0)};
}

Se3 const kBracketInWorld = placed_at({0, 0, 0}, 0.3);

FramePtr desk_frame(bool with_bracket = true, Se3 const& T_world_camera = before_desk(),
                    std::int64_t index = 0) {
  std::vector<Placed> things = desk_and_floor();
  if (with_bracket) {
    things.push_back({bracket(), kBracketInWorld});
  }
  return frame_of(things, T_world_camera, {SensorModel::kGaussian, 1, index});
}

Se3 truth_from(Se3 const& T_world_camera = before_desk()) {
  return T_world_camera.inverse() * kBracketInWorld;
}

void expect_at(ObjectAnswer const& answer, Se3 const& truth) {
  ASSERT_EQ(answer.verdict, ObjectVerdict::kFound);
  ASSERT_TRUE(answer.detection.has_value());
  EXPECT_EQ(answer.detection->type, "bracket");
  SearchModel const& model = prepared_bracket();
  EXPECT_LT(
      mean_distance_m(model, camera_pose(answer.detection->pose_camera.mean), camera_pose(truth)),
      0.1 * static_cast<double>(model.diameter_m));
  EXPECT_GE(answer.detection->score, 0.5);
  EXPECT_LE(answer.detection->score, 1.0);
  EXPECT_GT(answer.detection->visible_fraction, 0.3);
  EXPECT_LE(answer.detection->visible_fraction, 1.0);
  EXPECT_GT(answer.detection->pose_camera.covariance.determinant(), 0.0);
}

ObjectVerdict verdict(Frame const& frame, DetectionRequest const& asked) {
  BpaDetector detector(models(), config_of(ObjectSearch::kTracked));
  std::vector<ObjectAnswer> const answers = detector.answers(frame, {asked});
  EXPECT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers.at(0).detection.has_value(), answers.at(0).verdict == ObjectVerdict::kFound);
  return answers.at(0).verdict;
}

TEST(BpaDetector, FindsWhatIsWhereItIsExpected) {
  BpaDetector detector(models(), config_of(ObjectSearch::kTracked));
  Se3 expected = truth_from();
  expected =
      Se3(expected.rotation(), expected.translation() + Eigen::Vector3d(0.008, 0.005, -0.006));
  std::vector<ObjectAnswer> const answers = detector.answers(*desk_frame(), {request(expected)});
  ASSERT_EQ(answers.size(), 1U);
  expect_at(answers[0], truth_from());
  EXPECT_EQ(detector.detect(*desk_frame(), {request(expected)}).size(), 1U);
}

TEST(BpaDetector, TellsTheWayRoundThatLiesNearest) {
  Eigen::Quaterniond const half_turn(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
  Se3 const T_world_box = placed_at({0.02, 0.03, 0}, 0.3);
  std::vector<Placed> things = desk_and_floor();
  things.push_back({nearly_symmetric_box(), T_world_box});
  Se3 const truth = before_desk().inverse() * T_world_box;
  BpaDetector detector({{"box", nearly_symmetric_box()}}, config_of(ObjectSearch::kTracked));
  std::vector<Detection> const found =
      detector.detect(*frame_of(things, before_desk(), {SensorModel::kGaussian}),
                      {request(truth * Se3(half_turn, Eigen::Vector3d::Zero()), "box")});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(boxminus(truth, found[0].pose_camera.mean).norm(), 0.02);
}

TEST(BpaDetector, FindsWhatIsAnywhere) {
  BpaDetector detector(models(), config_of(ObjectSearch::kGlobal));
  std::vector<ObjectAnswer> const answers =
      detector.answers(*desk_frame(), {vague_request(before_desk().inverse())});
  ASSERT_EQ(answers.size(), 1U);
  expect_at(answers[0], truth_from());
}

// A search tells eight poses, and several of them may be in one place.
TEST(BpaDetector, FindsAllOfMoreThanOneSearchTells) {
  std::vector<Placed> things = desk_and_floor();
  std::vector<Se3> truths;
  std::vector<DetectionRequest> requests;
  for (int i = 0; i < 10; ++i) {
    Se3 const T_world_bracket =
        placed_at({-0.4 + 0.2 * (i % 5), -0.12 + 0.24 * (i / 5), 0}, 0.3 + 0.4 * (i % 3));
    things.push_back({bracket(), T_world_bracket});
    truths.push_back(before_desk().inverse() * T_world_bracket);
    requests.push_back(vague_request(before_desk().inverse()));
    requests.back().object_id = "bracket_" + std::to_string(i);
  }
  FramePtr const frame = frame_of(things, before_desk(), {SensorModel::kGaussian});
  BpaDetector detector(models(), config_of(ObjectSearch::kGlobal));
  std::vector<Detection> const found = detector.detect(*frame, requests);
  for (Se3 const& truth : truths) {
    EXPECT_EQ(std::ranges::count_if(found,
                                    [&](Detection const& one) {
                                      return boxminus(truth, one.pose_camera.mean).norm() < 0.1;
                                    }),
              1);
  }
}

TEST(BpaDetector, SearchesNearByOnlyWhereTold) {
  EXPECT_NE(verdict(*desk_frame(), vague_request(before_desk().inverse())), ObjectVerdict::kFound);
}

TEST(BpaDetector, WhatIsGoneIsAbsent) {
  EXPECT_EQ(verdict(*desk_frame(false), request(truth_from())), ObjectVerdict::kAbsent);
}

TEST(BpaDetector, WhatStandsBehindSomethingIsOccluded) {
  std::vector<Placed> things = desk_and_floor();
  things.push_back(
      {{"ball", std::vector<Solid>{SphereSolid{0.2}}, {}}, placed_at({0.0, -0.35, 0})});
  FramePtr const frame = frame_of(things, before_desk());
  EXPECT_EQ(verdict(*frame, request(truth_from())), ObjectVerdict::kOccluded);
}

// A plane larger than the object is no place for it, and hides it all the same.
TEST(BpaDetector, WhatStandsBehindAScreenIsOccludedToo) {
  Frame screen;
  screen.cloud_camera = cloud_from_depth(Grid<float>(640, 480, 0.5F), screen.intrinsics);
  EXPECT_EQ(verdict(screen, request(truth_from())), ObjectVerdict::kOccluded);
}

TEST(BpaDetector, WithoutDepthItMayWellBeThere) {
  Frame blind;
  blind.cloud_camera = cloud_from_depth(Grid<float>(640, 480, 0.0F), blind.intrinsics);
  EXPECT_EQ(verdict(blind, request(truth_from())), ObjectVerdict::kOccluded);
  BpaDetector everywhere(models(), config_of(ObjectSearch::kGlobal));
  EXPECT_THAT(everywhere.detect(blind, {request(truth_from())}), IsEmpty());
}

TEST(BpaDetector, OutsideOfTheImageIsOutOfView) {
  Se3 const aside(truth_from().rotation(), truth_from().translation() + Eigen::Vector3d(5, 0, 0));
  EXPECT_EQ(verdict(*desk_frame(), request(aside)), ObjectVerdict::kOutOfView);
  Se3 const behind(truth_from().rotation(), {0, 0, -1});
  EXPECT_EQ(verdict(*desk_frame(), request(behind)), ObjectVerdict::kOutOfView);
}

TEST(BpaDetector, ATypeWithoutAModelIsAbsent) {
  for (ObjectSearch const search :
       {ObjectSearch::kTracked, ObjectSearch::kGlobal, ObjectSearch::kBoth}) {
    BpaDetector detector(models(), config_of(search, 1, 1));
    for (std::int64_t index = 0; index < 3; ++index) {
      std::vector<ObjectAnswer> const answers = detector.answers(
          *desk_frame(true, before_desk(), index), {request(truth_from(), "ghost")});
      ASSERT_EQ(answers.size(), 1U);
      EXPECT_EQ(answers[0].verdict, ObjectVerdict::kAbsent);
      EXPECT_FALSE(answers[0].detection.has_value());
    }
  }
}

TEST(BpaDetector, AnswersComeInTheOrderOfTheRequests) {
  BpaDetector detector(models(), config_of(ObjectSearch::kTracked));
  Se3 const aside(truth_from().rotation(), truth_from().translation() + Eigen::Vector3d(5, 0, 0));
  std::vector<ObjectAnswer> const answers = detector.answers(
      *desk_frame(), {request(truth_from(), "ghost"), request(aside), request(truth_from())});
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[0].verdict, ObjectVerdict::kAbsent);
  EXPECT_EQ(answers[1].verdict, ObjectVerdict::kOutOfView);
  EXPECT_EQ(answers[2].verdict, ObjectVerdict::kFound);
}

TEST(BpaDetector, WithoutRequestsThereIsNothing) {
  for (ObjectSearch const search :
       {ObjectSearch::kTracked, ObjectSearch::kGlobal, ObjectSearch::kBoth}) {
    BpaDetector detector(models(), config_of(search));
    EXPECT_THAT(detector.answers(*desk_frame(), {}), IsEmpty());
    EXPECT_THAT(detector.detect(*desk_frame(), {}), IsEmpty());
  }
}

TEST(BpaDetector, NothingIsLikelyEnough) {
  BpaConfig config = config_of(ObjectSearch::kTracked);
  config.min_probability = 0.99999;
  BpaDetector detector(models(), config);
  EXPECT_THAT(detector.detect(*desk_frame(), {request(truth_from())}), IsEmpty());
}

TEST(BpaDetector, AModelWithoutASurfaceIsAnError) {
  ObjectModels ghosts = models();
  ghosts["ghost"] = {"ghost", TriangleMesh{}, {}};
  EXPECT_THROW(BpaDetector(ghosts, {}), InputError);
}

TEST(BpaDetector, KnowsItsModels) {
  BpaDetector const detector(models(), {});
  ASSERT_EQ(detector.models().size(), 2U);
  EXPECT_EQ(detector.models().at("can")->model.name, "can");
}

/// A camera that goes round the desk.
Se3 camera_in(std::int64_t index) {
  return looking_at({0.05 + 0.03 * static_cast<double>(index), -0.8, 0.6}, {0.0, 0.0, 0.05});
}

/// Whether the bracket is found in each frame, expected where it is not.
struct Told {
  std::vector<bool> found;
  std::vector<Detection> detections;
};
Told told_by(BpaConfig const& config, std::int64_t frames) {
  BpaDetector detector(models(), config);
  Told told;
  for (std::int64_t index = 0; index < frames; ++index) {
    Se3 const T_world_camera = camera_in(index);
    FramePtr const frame = desk_frame(true, T_world_camera, index);
    std::vector<ObjectAnswer> const answers =
        detector.answers(*frame, {vague_request(T_world_camera.inverse())});
    told.found.push_back(answers.at(0).verdict == ObjectVerdict::kFound);
    if (answers.at(0).detection) {
      expect_at(answers.at(0), truth_from(T_world_camera));
      told.detections.push_back(*answers.at(0).detection);
    }
  }
  return told;
}

TEST(BpaDetector, WhatIsFoundEverywhereIsToldLaterAsTheCameraSeesItThen) {
  EXPECT_THAT(told_by(config_of(ObjectSearch::kBoth, 1, 3), 8).found,
              ElementsAre(false, false, false, true, false, false, false, true));
}

TEST(BpaDetector, ALagOfOneIsTheNextFrame) {
  EXPECT_THAT(told_by(config_of(ObjectSearch::kBoth, 1, 1), 4).found,
              ElementsAre(false, true, false, true));
}

TEST(BpaDetector, WhatIsToldLaterFollowsTheCamerasWay) {
  BpaDetector detector(models(), config_of(ObjectSearch::kBoth, 1, 1));
  Se3 const aside(before_desk().rotation(),
                  before_desk().translation() + Eigen::Vector3d(0.12, 0, 0));
  (void)detector.answers(*desk_frame(), {vague_request(before_desk().inverse())});
  std::vector<ObjectAnswer> const answers =
      detector.answers(*desk_frame(true, aside, 1), {vague_request(aside.inverse())});
  expect_at(answers.at(0), truth_from(aside));
}

TEST(BpaDetector, ItSearchesEverywhereOnceInSoManyFrames) {
  EXPECT_THAT(told_by(config_of(ObjectSearch::kBoth, 4, 2), 8).found,
              ElementsAre(false, false, true, false, false, false, true, false));
}

TEST(BpaDetector, WithoutALagTheFrameWaitsForTheSearch) {
  EXPECT_THAT(told_by(config_of(ObjectSearch::kBoth, 1, 0), 3).found,
              ElementsAre(true, true, true));
}

TEST(BpaDetector, ALagOfMinusOneTakesWhatIsReady) {
  BpaDetector detector(models(), config_of(ObjectSearch::kBoth, 1, -1));
  FramePtr const frame = desk_frame();
  DetectionRequest const asked = vague_request(before_desk().inverse());
  EXPECT_FALSE(detector.answers(*frame, {asked}).at(0).detection.has_value());
  for (int tries = 0; tries < 600; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::vector<ObjectAnswer> const answers = detector.answers(*frame, {asked});
    if (answers.at(0).detection) {
      expect_at(answers.at(0), truth_from());
      return;
    }
  }
  FAIL() << "never ready";
}

TEST(BpaDetector, WhatIsFoundWhereExpectedIsNotSearchedForElsewhere) {
  BpaDetector detector(models(), config_of(ObjectSearch::kBoth, 1, 1));
  for (std::int64_t index = 0; index < 3; ++index) {
    std::vector<ObjectAnswer> const answers =
        detector.answers(*desk_frame(true, before_desk(), index), {request(truth_from())});
    expect_at(answers.at(0), truth_from());
  }
}

TEST(BpaDetector, WhatIsNoLongerAskedForIsForgotten) {
  BpaDetector detector(models(), config_of(ObjectSearch::kBoth, 1, 1));
  (void)detector.answers(*desk_frame(), {vague_request(before_desk().inverse())});
  EXPECT_THAT(detector.answers(*desk_frame(true, before_desk(), 1), {}), IsEmpty());
}

void expect_same(std::vector<Detection> const& one, std::vector<Detection> const& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].score, other[i].score);
    EXPECT_EQ(one[i].visible_fraction, other[i].visible_fraction);
    EXPECT_EQ(one[i].pose_camera.mean.matrix(), other[i].pose_camera.mean.matrix());
    EXPECT_EQ(one[i].pose_camera.covariance, other[i].pose_camera.covariance);
  }
}

TEST(BpaDetector, AnswersAreTheSameAtAnyNumberOfThreads) {
  BpaConfig const config = config_of(ObjectSearch::kBoth, 1, 2);
  Told const unlimited = told_by(config, 3);
  EXPECT_EQ(unlimited.detections.size(), 1U);
  for (std::size_t const threads : {std::size_t{1}, std::size_t{3}}) {
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, threads);
    Told const again = told_by(config, 3);
    EXPECT_EQ(again.found, unlimited.found);
    expect_same(again.detections, unlimited.detections);
  }
}

TEST(BpaDetector, AnotherSeedIsAnotherDraw) {
  auto const tracked = [](int seed) {
    BpaConfig config = config_of(ObjectSearch::kTracked);
    config.seed = seed;
    BpaDetector detector(models(), config);
    DetectionRequest asked = request(truth_from());
    asked.expected_camera = around(truth_from(), 0.02, 0.1);
    return detector.detect(*desk_frame(), {asked});
  };
  std::vector<Detection> const one = tracked(1);
  expect_same(one, tracked(1));
  std::vector<Detection> const other = tracked(2);
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(other.size(), 1U);
  EXPECT_NE(one[0].pose_camera.mean.matrix(), other[0].pose_camera.mean.matrix());
}

}  // namespace
}  // namespace credo::test
