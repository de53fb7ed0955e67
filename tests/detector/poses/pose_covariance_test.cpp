#include "detector/poses/pose_covariance.hpp"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <vector>

#include "detector/poses/pose_refinement.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

Eigen::Quaterniond some_rotation() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, -0.6, 0.4).normalized()));
}

double smallest_eigenvalue(Matrix6d const& matrix) {
  return Eigen::SelfAdjointEigenSolver<Matrix6d>(matrix).eigenvalues()[0];
}

/// Deviation of a shift and a turn along a direction in the camera frame.
double shift_m(PoseDistribution const& pose, Eigen::Vector3d const& direction) {
  return std::sqrt(direction.dot(pose.covariance.topLeftCorner<3, 3>() * direction));
}
double turn_rad(PoseDistribution const& pose, Eigen::Vector3d const& direction) {
  return std::sqrt(direction.dot(pose.covariance.bottomRightCorner<3, 3>() * direction));
}

TEST(PoseCovariance, IsPositiveDefiniteAndSymmetric) {
  BracketView const view = bracket_on_desk(0.3, {SensorModel::kDisparity});
  std::vector<CameraPose> poses = {view.truth};
  CameraPose nowhere = view.truth;
  nowhere.translation_m = {3, 0, 1};
  poses.push_back(nowhere);
  for (CameraPose const& pose : poses) {
    PoseDistribution const told = with_covariance(prepared_bracket(), view.scene, pose);
    EXPECT_GT(smallest_eigenvalue(told.covariance), 0.0);
    EXPECT_TRUE(told.covariance.isApprox(told.covariance.transpose(), 1e-12));
    EXPECT_LT(boxminus(told.mean, se3(pose)).norm(), 1e-9);
  }
}

TEST(PoseCovariance, WhereNothingIsSeenNothingIsKnown) {
  PoseDistribution const told =
      with_covariance(prepared_bracket(), SearchScene{}, bracket_alone(some_rotation()).truth);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(told.covariance(axis, axis)), 1.0, 1e-3);
    EXPECT_NEAR(std::sqrt(told.covariance(axis + 3, axis + 3)), 2.0, 1e-3);
  }
}

TEST(PoseCovariance, OfWhatIsSeenWellIsSmall) {
  BracketView const view = bracket_alone(some_rotation());
  PoseDistribution const told = with_covariance(prepared_bracket(), view.scene, view.truth);
  Eigen::Vector3d const ray = view.T_camera_model.translation().normalized();
  EXPECT_LT(shift_m(told, ray), 0.005);
  EXPECT_GT(shift_m(told, ray), 0.0001);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(std::sqrt(told.covariance(axis + 3, axis + 3)), 0.1);
    EXPECT_GT(std::sqrt(told.covariance(axis + 3, axis + 3)), 0.001)
        << "errors that all points have in common do not average out";
  }
}

TEST(PoseCovariance, WhatFitsPoorlyTellsLess) {
  BracketView const view = bracket_alone(some_rotation(), {SensorModel::kDisparity});
  PoseDistribution const right = with_covariance(prepared_bracket(), view.scene, view.truth);
  CameraPose const off = perturbed(prepared_bracket(), view.truth, {0, 0, 0.006F}, {0, 0, 0});
  PoseDistribution const poor = with_covariance(prepared_bracket(), view.scene, off);
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_GT(poor.covariance(axis, axis), 1.3 * right.covariance(axis, axis)) << axis;
  }
}

TEST(PoseCovariance, ACansTurnIsKnownLeast) {
  SearchModel const model = prepare_model(can(0.05, 0.14));
  Se3 const pose(
      Eigen::Quaterniond(Eigen::AngleAxisd(2.2, Eigen::Vector3d(1, 0.2, 0.1).normalized())),
      {0.02, -0.03, 0.9});
  SearchScene const scene = scene_of(*frame_of({{can(0.05, 0.14), pose}}, {}));
  PoseDistribution const told = with_covariance(model, scene, camera_pose(pose));
  Eigen::Vector3d const axis = pose.rotation() * Eigen::Vector3d::UnitZ();
  for (Eigen::Vector3d const& across : {Eigen::Vector3d(axis.unitOrthogonal()),
                                        Eigen::Vector3d(axis.cross(axis.unitOrthogonal()))}) {
    EXPECT_LT(turn_rad(told, across), 0.1);
    EXPECT_GT(turn_rad(told, axis), 3.0 * turn_rad(told, across));
  }
}

TEST(PoseCovariance, APlateSlidesInItsPlane) {
  ObjectModel const plate{
      "plate", std::vector<Solid>{BoxSolid{{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.002}}}, {}};
  SearchModel const model = prepare_model(plate);
  Se3 const pose(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX())),
                 {0.0, 0.0, 0.8});
  SearchScene const scene = scene_of(*frame_of({{plate, pose}}, {}));
  PoseDistribution const told = with_covariance(model, scene, camera_pose(pose));
  EXPECT_GT(shift_m(told, Eigen::Vector3d::UnitX()), 0.5);
  EXPECT_GT(shift_m(told, Eigen::Vector3d::UnitY()), 0.5);
  EXPECT_LT(shift_m(told, Eigen::Vector3d::UnitZ()), 0.005);
  EXPECT_GT(turn_rad(told, Eigen::Vector3d::UnitZ()), 1.0);
  EXPECT_LT(turn_rad(told, Eigen::Vector3d::UnitX()), 0.1);
  EXPECT_LT(turn_rad(told, Eigen::Vector3d::UnitY()), 0.1);
}

TEST(PoseCovariance, FartherAwayIsLessSure) {
  double before_m = 0.0;
  for (double const z : {0.7, 1.2, 2.0}) {
    Se3 const pose(some_rotation(), {0, 0, z});
    SearchScene const scene = scene_of(*frame_of({{bracket(), pose}}, {}));
    PoseDistribution const told = with_covariance(prepared_bracket(), scene, camera_pose(pose));
    double const across_m = shift_m(told, Eigen::Vector3d::UnitX());
    EXPECT_GT(across_m, before_m) << z;
    before_m = across_m;
  }
}

TEST(PoseCovariance, IsAboutWhatRefinedPosesStray) {
  SearchModel const& model = prepared_bracket();
  constexpr int kRuns = 12;
  double sum = 0.0;
  double sum_covariance_m = 0.0;
  double sum_error_m = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    BracketView const view = bracket_alone(some_rotation(), {SensorModel::kGaussian, run + 1});
    CameraPose const found = refined(model, view.scene, view.truth, {15, 800, 0.02F});
    PoseDistribution const told = with_covariance(model, view.scene, found);
    Vector6d const error = boxminus(view.T_camera_model, told.mean);
    sum += error.dot(told.covariance.ldlt().solve(error));
    sum_covariance_m += told.covariance.topLeftCorner<3, 3>().trace();
    sum_error_m += error.head<3>().squaredNorm();
  }
  // Six for a perfect one.
  RecordProperty("mean_nees", std::to_string(sum / kRuns));
  EXPECT_GT(sum / kRuns, 0.1);
  EXPECT_LT(sum / kRuns, 40.0);
  EXPECT_GT(sum_error_m, sum_covariance_m / 50.0);
  EXPECT_LT(sum_error_m, sum_covariance_m * 25.0);
}

}  // namespace
}  // namespace credo::test
