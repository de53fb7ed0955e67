#include "detector/poses/pose_refinement.hpp"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

Eigen::Quaterniond some_rotation(double angle = 1.1) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, -0.6, 0.4).normalized()));
}

CameraPose slightly_off(CameraPose const& truth, std::mt19937& random) {
  std::normal_distribution<float> number;
  auto const direction = [&] {
    return Vector3f(number(random), number(random), number(random)).normalized();
  };
  return perturbed(prepared_bracket(), truth, 0.008F * direction(), 0.07F * direction());
}

TEST(PoseRefinement, BringsAPoseBack) {
  std::mt19937 random(1);
  BracketView const view = bracket_alone(some_rotation());
  for (int i = 0; i < 5; ++i) {
    CameraPose const start = slightly_off(view.truth, random);
    CameraPose const moved = refined(prepared_bracket(), view.scene, start, {15, 800, 0.03F});
    EXPECT_LT(mean_distance_m(prepared_bracket(), moved, view.truth), 0.0015);
    EXPECT_LT(angle_between(moved, view.truth), 0.02);
  }
}

TEST(PoseRefinement, BringsAPoseBackThroughNoise) {
  std::mt19937 random(2);
  for (SensorModel const sensor : {SensorModel::kGaussian, SensorModel::kDisparity}) {
    BracketView const view = bracket_on_desk(0.5, {sensor});
    for (int i = 0; i < 5; ++i) {
      CameraPose const start = slightly_off(view.truth, random);
      CameraPose const moved = refined(prepared_bracket(), view.scene, start, {15, 800, 0.03F});
      EXPECT_LT(mean_distance_m(prepared_bracket(), moved, view.truth), 0.006);
      EXPECT_LT(mean_distance_m(prepared_bracket(), moved, view.truth),
                mean_distance_m(prepared_bracket(), start, view.truth));
    }
  }
}

TEST(PoseRefinement, StaysAMotion) {
  std::mt19937 random(3);
  BracketView const view = bracket_alone(some_rotation());
  CameraPose const moved =
      refined(prepared_bracket(), view.scene, slightly_off(view.truth, random), {30, 800, 0.03F});
  EXPECT_LT((moved.rotation * moved.rotation.transpose() - Eigen::Matrix3f::Identity()).norm(),
            1e-5F);
}

void expect_unchanged(CameraPose const& pose, SearchScene const& scene) {
  CameraPose const same = refined(prepared_bracket(), scene, pose, {5, 400, 0.03F});
  EXPECT_EQ(same.rotation, pose.rotation);
  EXPECT_EQ(same.translation_m, pose.translation_m);
}

TEST(PoseRefinement, WithoutContactsThePoseStays) {
  BracketView const view = bracket_alone(some_rotation());
  CameraPose pose = view.truth;
  pose.translation_m.x() += 0.4F;
  expect_unchanged(pose, view.scene);
  pose = view.truth;
  pose.translation_m.z() += 0.2F;
  expect_unchanged(pose, view.scene);
  pose.translation_m = {0, 0, -1};
  expect_unchanged(pose, view.scene);
  pose.translation_m = {10, 0, 1};
  expect_unchanged(pose, view.scene);
  expect_unchanged(view.truth, SearchScene{});
}

TEST(PoseRefinement, ALargePlaneAndNormalsThatDisagreeDrawNothing) {
  BracketView const view = bracket_on_desk(0.3);
  ASSERT_FALSE(view.scene.planes.empty());
  SearchScene plane = view.scene;
  SearchScene turned = view.scene;
  for (std::size_t i = 0; i < plane.pixels.size(); ++i) {
    plane.pixels[i].plane = 0;
    turned.pixels[i].normal = {0, 0, 127};
  }
  expect_unchanged(view.truth, plane);
  expect_unchanged(view.truth, turned);
}

TEST(PoseRefinement, WithoutIterationsThePoseStays) {
  BracketView const view = bracket_alone(some_rotation());
  CameraPose const start = perturbed(prepared_bracket(), view.truth, {0.005F, 0, 0}, {0, 0, 0});
  CameraPose const same = refined(prepared_bracket(), view.scene, start, {0, 400, 0.03F});
  EXPECT_LT((same.rotation - start.rotation).norm(), 1e-6F);
  EXPECT_EQ(same.translation_m, start.translation_m);
}

TEST(PoseRefinement, IsTheSameEachTime) {
  std::mt19937 random(4);
  BracketView const view = bracket_on_desk(0.5, {SensorModel::kGaussian});
  CameraPose const start = slightly_off(view.truth, random);
  CameraPose const one = refined(prepared_bracket(), view.scene, start, {});
  CameraPose const again = refined(prepared_bracket(), view.scene, start, {});
  EXPECT_EQ(one.rotation, again.rotation);
  EXPECT_EQ(one.translation_m, again.translation_m);
}

}  // namespace
}  // namespace credo::test
