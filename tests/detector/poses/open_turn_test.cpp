#include "detector/poses/open_turn.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "detector/poses/pose_covariance.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"
#include "sim/household.hpp"

namespace credo::test {
namespace {

double turn_rad(PoseDistribution const& pose, Eigen::Vector3d const& axis) {
  return std::sqrt(axis.dot(pose.covariance.bottomRightCorner<3, 3>() * axis));
}

/// The mug, turned about the axis of its cup. Its origin is the middle of cup and handle.
Se3 turned(Se3 const& T_camera_mug, double angle_rad) {
  Eigen::Vector3d const on_axis(-0.0173, 0.0, 0.0);
  Eigen::Quaterniond const turn(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
  return T_camera_mug * Se3(turn, on_axis - turn * on_axis);
}

/// A mug on a desk, its handle so many radians away from the camera's side.
struct MugView {
  SearchModel model;
  SearchScene scene;
  Se3 T_camera_mug;
};
MugView mug_view(double yaw_rad) {
  std::vector<ObjectModel> const things = household_models();
  ObjectModel const mug = *std::ranges::find(things, "mug", &ObjectModel::name);
  std::vector<Placed> placed = desk_and_floor();
  Se3 const T_world_mug = placed_at({0.0, 0.0, 0.0475}, yaw_rad);
  placed.push_back({mug, T_world_mug});
  Se3 const T_world_camera = looking_at({0.0, -0.9, 0.5}, {0.0, 0.0, 0.05});
  return {prepare_model(mug),
          scene_of(*frame_of(placed, T_world_camera, {SensorModel::kDisparity, 3, 0})),
          T_world_camera.inverse() * T_world_mug};
}

TEST(OpenTurn, AHandleThatIsHiddenLeavesTheTurnOpen) {
  MugView const view = mug_view(std::numbers::pi / 2.0);
  Eigen::Vector3d const axis = view.T_camera_mug.rotation() * Eigen::Vector3d::UnitZ();
  for (double const off_rad : {-0.3, 0.0, 0.3}) {
    PoseDistribution const told =
        with_covariance(view.model, view.scene, camera_pose(turned(view.T_camera_mug, off_rad)));
    EXPECT_GT(turn_rad(told, axis), 0.2) << off_rad;
    EXPECT_LT(turn_rad(told, axis), 0.9) << off_rad;
    Vector6d const error = boxminus(view.T_camera_mug, told.mean);
    EXPECT_LT(error.dot(told.covariance.inverse() * error), 16.8) << off_rad << ", 99 %";
    // Wherever in the gap one begins, the mean comes to be amid it.
    EXPECT_LT(std::abs(error.tail<3>().dot(axis)), 0.25) << off_rad;
  }
}

TEST(OpenTurn, AHandleThatShowsTellsTheTurn) {
  MugView const view = mug_view(0.0);
  Eigen::Vector3d const axis = view.T_camera_mug.rotation() * Eigen::Vector3d::UnitZ();
  PoseDistribution const told =
      with_covariance(view.model, view.scene, camera_pose(view.T_camera_mug));
  EXPECT_LT(turn_rad(told, axis), 0.1);
  EXPECT_LT(boxminus(view.T_camera_mug, told.mean).norm(), 1e-6);
}

TEST(OpenTurn, AllAroundTheHandleIsFound) {
  MugView const view = mug_view(0.0);
  for (double const off_rad : {1.0, 2.0, 3.1, -1.3}) {
    CameraPose const pose = camera_pose(turned(view.T_camera_mug, off_rad));
    PoseCandidate const wrong{pose, verified(view.model, view.scene, pose, {})};
    std::vector<PoseCandidate> const others =
        other_turns(view.model, view.scene, wrong, pose_information(view.model, view.scene, pose));
    ASSERT_FALSE(others.empty()) << off_rad;
    // Those with the handle behind the cup explain the cup as well, but not the handle.
    int most_net_px = wrong.verification.net_px();
    for (PoseCandidate const& other : others) {
      most_net_px = std::max(most_net_px, other.verification.net_px());
    }
    auto const best = std::ranges::max_element(others, {}, [&](PoseCandidate const& candidate) {
      return log_odds_beside(candidate.verification, most_net_px);
    });
    EXPECT_GT(log_odds_beside(best->verification, most_net_px),
              log_odds_beside(wrong.verification, most_net_px))
        << off_rad;
    EXPECT_LT(boxminus(view.T_camera_mug, se3(best->pose)).norm(), 0.1) << off_rad;
  }
}

TEST(OpenTurn, OfARoundThingNoTurnIsLookedFor) {
  MugView view = mug_view(0.0);
  view.model.symmetry.axis = SymmetryAxis{};
  CameraPose const pose = camera_pose(view.T_camera_mug);
  Matrix6d const information = Matrix6d::Identity();
  EXPECT_EQ(open_turn(view.model, view.scene, pose, information).covariance, Matrix6d::Zero());
  EXPECT_TRUE(other_turns(view.model, view.scene, {pose, {}}, information).empty());
}

}  // namespace
}  // namespace credo::test
