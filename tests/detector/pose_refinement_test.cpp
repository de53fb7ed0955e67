#include "detector/pose_refinement.hpp"

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

/// Of one point's distance to a plane that stays, by central differences of boxplus.
Vector6d numeric_gradient(Se3 const& pose, Eigen::Vector3d const& p_model,
                          Eigen::Vector3d const& normal_camera) {
  constexpr double kStep = 1e-5;
  Vector6d gradient;
  for (int axis = 0; axis < 6; ++axis) {
    Vector6d error = Vector6d::Zero();
    error[axis] = kStep;
    Eigen::Vector3d const ahead = boxplus(pose, error) * p_model;
    Eigen::Vector3d const behind = boxplus(pose, -error) * p_model;
    gradient[axis] = normal_camera.dot(ahead - behind) / (2.0 * kStep);
  }
  return gradient;
}

/// Whether the scene has its surface there, turned the same way.
bool lies_on(SearchScene const& scene, Eigen::Vector3d const& p, Eigen::Vector3d const& normal) {
  CameraIntrinsics const& camera = scene.intrinsics;
  Pixel const at{static_cast<int>(std::lround(camera.fx_px * p.x() / p.z() + camera.cx_px)),
                 static_cast<int>(std::lround(camera.fy_px * p.y() / p.z() + camera.cy_px))};
  ScenePixel const& seen = scene.pixels[at];
  return std::abs(static_cast<double>(seen.depth_m) - p.z()) < 0.015 &&
         (!seen.has_normal() || seen.normal_camera().cast<double>().dot(normal) > 0.5);
}

TEST(PoseEvidence, IsWhatNumericDerivativesSay) {
  SearchModel const& model = prepared_bracket();
  for (double const angle : {0.3, 1.1, 2.5}) {
    BracketView const view = bracket_alone(some_rotation(angle));
    PoseEvidence const evidence = evidence_of(model, view.scene, view.truth, 2000);
    ASSERT_GT(evidence.points, 200);
    Vector3f const centre = view.truth * model.centre_model;
    ModelView const& side = model.view_from(-(view.truth.rotation.transpose() * centre));
    Matrix6d literal = Matrix6d::Zero();
    for (std::uint16_t const i : side.visible) {
      Eigen::Vector3d const normal = (view.truth.rotation * model.normals_model[i]).cast<double>();
      if (!lies_on(view.scene, view.T_camera_model * model.points_model[i].cast<double>(),
                   normal)) {
        continue;
      }
      Vector6d const g =
          numeric_gradient(view.T_camera_model, model.points_model[i].cast<double>(), normal);
      literal += g * g.transpose();
    }
    // The deviation of a point is the sensor's: up to it, the two are the same.
    Matrix6d const told = evidence.information / evidence.information.topLeftCorner<3, 3>().trace();
    Matrix6d const wanted = literal / literal.topLeftCorner<3, 3>().trace();
    Vector6d scale;
    scale << 1, 1, 1, 0.07, 0.07, 0.07;  // a radian moves the points by about so much
    Matrix6d const error = ((told - wanted).array() / (scale * scale.transpose()).array()).matrix();
    Matrix6d const size = (wanted.array() / (scale * scale.transpose()).array()).matrix();
    EXPECT_LT(error.norm(), 0.2 * size.norm()) << told << "\n\n" << wanted;
  }
}

TEST(PoseEvidence, ResidualsAreLeastAtTheTruth) {
  BracketView const view = bracket_alone(some_rotation());
  SearchModel const& model = prepared_bracket();
  PoseEvidence const right = evidence_of(model, view.scene, view.truth, 800);
  EXPECT_LT(right.mean_squared_residual, 0.5);
  EXPECT_LE(right.points, 800);
  EXPECT_TRUE(right.information.isApprox(right.information.transpose(), 1e-9));
  CameraPose const off = perturbed(model, view.truth, {0, 0, 0.006F}, {0, 0, 0});
  EXPECT_GT(evidence_of(model, view.scene, off, 800).mean_squared_residual,
            2.0 * right.mean_squared_residual);
  EXPECT_LT(evidence_of(model, view.scene, view.truth, 50).points, 51);
}

TEST(PoseEvidence, WithoutContactsThereIsNone) {
  PoseEvidence const none =
      evidence_of(prepared_bracket(), SearchScene{}, bracket_alone(some_rotation()).truth, 800);
  EXPECT_EQ(none.points, 0);
  EXPECT_EQ(none.information, Matrix6d::Zero());
  EXPECT_EQ(none.mean_squared_residual, 0.0);
}

}  // namespace
}  // namespace credo::test
