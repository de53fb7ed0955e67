#include "stages/detection/detection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace credo {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kSigma_m = 0.03;
constexpr double kSigma_rad = 0.05;
// boost's chi-square quantiles at 0.999, as printed in tables: 6 and 5 degrees of freedom.
constexpr double kGate6 = 22.458;
constexpr double kGate5 = 20.515;

Matrix6d covariance(double position_m, double rotation_rad) {
  Vector6d variance;
  variance << Vector3d::Constant(position_m * position_m),
      Vector3d::Constant(rotation_rad * rotation_rad);
  return variance.asDiagonal();
}

void add_object(BeliefState& belief, std::string id, std::string type, Vector3d const& p_world) {
  ObjectBelief& object = belief.objects.emplace_back();
  object.id = std::move(id);
  object.type = std::move(type);
  object.pose_world = {Se3(Eigen::Quaterniond::Identity(), p_world),
                       covariance(kSigma_m, kSigma_rad)};
}

/// Where the camera stands in these tests: turned and away from the world's origin.
Se3 camera() {
  return {so3_exp({0.4, -1.2, 0.7}), {1, 2, 3}};
}

Detection detected(std::string type, Se3 const& pose_world) {
  Detection detection;
  detection.type = std::move(type);
  detection.pose_camera = {camera().inverse() * pose_world, covariance(0.04, kSigma_rad)};
  return detection;
}

Detection detected_at(std::string type, Vector3d const& p_world) {
  return detected(std::move(type), {Eigen::Quaterniond::Identity(), p_world});
}

Segmentation matched(BeliefState const& belief, std::vector<Detection> const& detections,
                     ObjectModels const& models = {}) {
  Segmentation segmentation;
  segmentation.T_world_camera = camera();
  return match_detections(std::move(segmentation), belief, detections, models, {});
}

std::vector<std::string> ids_of(Segmentation const& segmentation) {
  std::vector<std::string> ids;
  for (ObjectObservation const& object : segmentation.objects) {
    ids.push_back(object.object_id);
  }
  return ids;
}

TEST(DetectionRequests, SayWhereTheCameraShouldSeeTheObjects) {
  BeliefState belief;
  add_object(belief, "box_1", "box", {1, 0, 0.5});
  add_object(belief, "can_1", "can", {0, 1, 0.5});
  std::vector<DetectionRequest> const requests = detection_requests(belief, camera());
  ASSERT_THAT(requests, SizeIs(2));
  EXPECT_EQ(requests[1].object_id, "can_1");
  EXPECT_EQ(requests[1].type, "can");
  Se3 const back = camera() * requests[1].expected_camera.mean;
  EXPECT_NEAR((back.translation() - Vector3d(0, 1, 0.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((requests[1].expected_camera.covariance - covariance(kSigma_m, kSigma_rad)).norm(), 0,
              1e-12);
}

TEST(MatchDetections, TellsWhichObjectWasSeenAndWhere) {
  BeliefState belief;
  add_object(belief, "can_1", "can", {0, 1, 0.5});
  add_object(belief, "box_1", "box", {1, 0, 0.5});
  Segmentation const result = matched(belief, {detected_at("box", {1.02, 0, 0.5})});
  EXPECT_TRUE(result.objects_looked_for);
  ASSERT_THAT(result.objects, SizeIs(1));
  ObjectObservation const& seen = result.objects[0];
  EXPECT_EQ(seen.label, kFirstObject + 1);
  EXPECT_EQ(seen.object, 1U);
  EXPECT_EQ(seen.object_id, "box_1");
  EXPECT_EQ(seen.type, "box");
  EXPECT_NEAR((seen.pose_world.mean.translation() - Vector3d(1.02, 0, 0.5)).norm(), 0, 1e-12);
  EXPECT_THAT(result.refused, IsEmpty());
}

// With 3 cm and 4 cm the sum is 5 cm: the gate is sqrt(22.458) of them away.
TEST(MatchDetections, TheGateIsAQuantileOfTheChiSquareDistribution) {
  BeliefState belief;
  add_object(belief, "box_1", "box", {1, 0, 0.5});
  double const edge_m = 0.05 * std::sqrt(kGate6);
  EXPECT_THAT(matched(belief, {detected_at("box", {1 + edge_m - 1e-4, 0, 0.5})}).objects,
              SizeIs(1));
  Segmentation const outside = matched(belief, {detected_at("box", {1 + edge_m + 1e-4, 0, 0.5})});
  EXPECT_THAT(outside.objects, IsEmpty());
  ASSERT_THAT(outside.refused, SizeIs(1));
  EXPECT_EQ(outside.refused[0].object_id, "box_1");
  EXPECT_NEAR(outside.refused[0].squared_distance, kGate6, 0.03);
  EXPECT_NEAR(outside.refused[0].max_squared_distance, kGate6, 1e-3);
  EXPECT_NEAR(
      (outside.refused[0].pose_world.mean.translation() - Vector3d(1 + edge_m + 1e-4, 0, 0.5))
          .norm(),
      0, 1e-12);
}

TEST(MatchDetections, AnAxisCostsTheGateADegreeOfFreedom) {
  BeliefState belief;
  add_object(belief, "can_1", "can", {1, 0, 0.5});
  ObjectModels const models = {
      {"can", {"can", {std::vector<Solid>{CylinderSolid{0.1, 0.2}}}, {SymmetryAxis{}, {}}}}};
  double const edge_m = 0.05 * std::sqrt(kGate5);
  Eigen::Quaterniond const turned = so3_exp({0, 0, 2.5});
  EXPECT_THAT(
      matched(belief, {detected("can", {turned, {1 + edge_m - 1e-3, 0, 0.5}})}, models).objects,
      SizeIs(1));
  EXPECT_THAT(
      matched(belief, {detected("can", {turned, {1 + edge_m + 1e-3, 0, 0.5}})}, models).objects,
      IsEmpty());
  EXPECT_THAT(matched(belief, {detected("can", {turned, {1, 0, 0.5}})}).objects, IsEmpty())
      << "without its model a can is no rounder than anything else";
}

TEST(MatchDetections, NearestFirstAndEachOnlyOnce) {
  BeliefState belief;
  add_object(belief, "left", "box", {0.00, 0, 0});
  add_object(belief, "right", "box", {0.10, 0, 0});
  // Both detections are within both gates. The second is the better one for "left".
  Segmentation const result =
      matched(belief, {detected_at("box", {0.04, 0, 0}), detected_at("box", {0.01, 0, 0})});
  EXPECT_THAT(ids_of(result), ElementsAre("left", "right"));
  EXPECT_NEAR(result.objects[0].pose_world.mean.translation().x(), 0.01, 1e-12);
  EXPECT_NEAR(result.objects[1].pose_world.mean.translation().x(), 0.04, 1e-12);
  // One more than there are objects: refused within the gate.
  Segmentation const crowd =
      matched(belief, {detected_at("box", {0.0, 0, 0}), detected_at("box", {0.1, 0, 0}),
                       detected_at("box", {0.05, 0, 0})});
  EXPECT_THAT(crowd.objects, SizeIs(2));
  ASSERT_THAT(crowd.refused, SizeIs(1));
  EXPECT_LT(crowd.refused[0].squared_distance, crowd.refused[0].max_squared_distance);
}

TEST(MatchDetections, EquallyNearOnesGoByOrder) {
  BeliefState belief;
  add_object(belief, "first", "box", {0, 0, 0});
  add_object(belief, "second", "box", {0, 0, 0});
  Detection const detection = detected_at("box", {0.01, 0, 0});
  EXPECT_THAT(ids_of(matched(belief, {detection})), ElementsAre("first"));
}

TEST(MatchDetections, OtherTypesAreNoObjectsOfTheBelief) {
  BeliefState belief;
  add_object(belief, "box_1", "box", {1, 0, 0.5});
  Segmentation const result = matched(belief, {detected_at("can", {1, 0, 0.5})});
  EXPECT_THAT(result.objects, IsEmpty());
  ASSERT_THAT(result.refused, SizeIs(1));
  EXPECT_EQ(result.refused[0].object_id, "");
  EXPECT_EQ(result.refused[0].squared_distance, std::numeric_limits<double>::infinity());
}

TEST(MatchDetections, NothingFoundIsNoError) {
  BeliefState belief;
  add_object(belief, "box_1", "box", {1, 0, 0.5});
  EXPECT_THAT(matched(belief, {}).objects, IsEmpty());
  EXPECT_THAT(matched({}, {detected_at("box", {1, 0, 0.5})}).refused, SizeIs(1));
}

std::string refusal(Detection const& detection) {
  BeliefState belief;
  add_object(belief, "box_1", "box", {1, 0, 0.5});
  try {
    (void)matched(belief, {detection});
    return "";
  } catch (std::runtime_error const& error) {
    return error.what();
  }
}

TEST(MatchDetections, ADetectorThatTalksNonsenseIsTold) {
  Detection bad = detected_at("box", {1, 0, 0.5});
  bad.pose_camera.covariance(2, 2) = 0;
  EXPECT_EQ(refusal(bad), "the detector gave a box whose covariance is not positive definite");
  bad.pose_camera.covariance(2, 2) = NAN;
  EXPECT_EQ(refusal(bad), "the detector gave a box whose pose or covariance is not finite");
}

// To an object of which little is known everything is near.
TEST(MatchDetections, ASharpObjectIsLikelierThanAVagueOneAtTheSameDistance) {
  BeliefState belief;
  add_object(belief, "vague", "box", {2.3, -0.3, 0.7});
  belief.objects[0].pose_world.covariance = covariance(1.0, 1.0);
  add_object(belief, "sharp", "box", {2.0, 0.12, 0.7});
  Segmentation const one = matched(belief, {detected_at("box", {2.0, 0.2, 0.7})});
  EXPECT_THAT(ids_of(one), ElementsAre("sharp"));
  Segmentation const far = matched(belief, {detected_at("box", {2.0, 0.9, 0.7})});
  EXPECT_THAT(ids_of(far), ElementsAre("vague")) << "the gate still holds";
}

}  // namespace
}  // namespace credo
