#include "detector/search/tracking.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>

#include "detector/poses/pose_distance.hpp"
#include "detector/poses/pose_refinement.hpp"
#include "detector/poses/pose_score.hpp"
#include "geometry/random_draws.hpp"

namespace credo {
namespace {

constexpr std::size_t kCoarsePoints = 100;
constexpr std::size_t kFinePoints = 500;

/// So many draws for a distribution no wider than this, at the model's centre and its rim.
struct Effort {
  double deviation_m;
  std::size_t draws;
  std::size_t kept;
};
constexpr std::array<Effort, 3> kEfforts = {Effort{0.012, 16, 4}, Effort{0.025, 150, 12},
                                            Effort{0.060, 600, 24}};

/// Standard deviations along the axes of the camera, in a pose whose origin is the model's centre.
struct Width {
  double position_m;
  double rotation_rad;
};

Width width_of(SearchModel const& model, PoseDistribution const& expected) {
  Eigen::Vector3d const centre = expected.mean.rotation() * model.centre_model.cast<double>();
  Eigen::Matrix<double, 3, 6> of_centre;
  of_centre << Eigen::Matrix3d::Identity(), -cross_matrix(centre);
  Eigen::Matrix3d const position = of_centre * expected.covariance * of_centre.transpose();
  Eigen::Matrix3d rotation = expected.covariance.bottomRightCorner<3, 3>();
  if (model.symmetry.axis) {
    // Turns about the axis show nothing, however vague they are.
    Eigen::Vector3d const axis = expected.mean.rotation() * model.symmetry.axis->direction;
    Eigen::Matrix3d const across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    rotation = across * rotation * across;
  }
  return {std::sqrt(position.diagonal().maxCoeff()), std::sqrt(rotation.diagonal().maxCoeff())};
}

double widest_m(SearchModel const& model, PoseDistribution const& expected) {
  Width const width = width_of(model, expected);
  return std::max(width.position_m, width.rotation_rad * 0.5 * static_cast<double>(model.radius_m));
}

std::vector<CameraPose> draws(PoseDistribution const& expected, std::uint64_t seed,
                              std::size_t count) {
  Eigen::SelfAdjointEigenSolver<Matrix6d> const solver(expected.covariance);
  Vector6d const deviations = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  std::mt19937_64 random(seed);
  std::vector<CameraPose> poses = {camera_pose(expected.mean)};
  while (poses.size() < count) {
    Vector6d error;
    for (double& value : error) {
      value = draw_normal(random);
    }
    error = solver.eigenvectors() * deviations.cwiseProduct(error);
    poses.push_back(camera_pose(boxplus(expected.mean, error)));
  }
  return poses;
}

struct Scored {
  CameraPose pose;
  float score = 0.0F;
};

void keep_best(std::vector<Scored>& poses, PoseDistance const& distance, float apart_m,
               std::size_t count) {
  std::ranges::stable_sort(poses, std::greater{}, &Scored::score);
  std::vector<Scored> kept;
  for (Scored const& pose : poses) {
    bool const apart = std::ranges::none_of(
        kept, [&](Scored const& better) { return distance(better.pose, pose.pose) < apart_m; });
    if (apart && kept.size() < count) {
      kept.push_back(pose);
    }
  }
  poses = std::move(kept);
}

}  // namespace

bool can_track(SearchModel const& model, PoseDistribution const& expected_camera) {
  return widest_m(model, expected_camera) <= kEfforts.back().deviation_m;
}

std::vector<PoseCandidate> search_near(SearchModel const& model, SearchScene const& scene,
                                       PoseDistribution const& expected_camera, std::uint64_t seed,
                                       std::size_t max_candidates) {
  double const widest = widest_m(model, expected_camera);
  auto const fitting = std::ranges::find_if(
      kEfforts, [&](Effort const& effort) { return widest <= effort.deviation_m; });
  Effort const& effort = fitting != kEfforts.end() ? *fitting : kEfforts.back();
  PoseScore const score(model, scene);
  PoseDistance const distance(model);
  std::vector<Scored> poses;
  for (CameraPose const& pose : draws(expected_camera, seed, effort.draws)) {
    poses.push_back({pose, score(pose, kCoarsePoints)});
  }
  keep_best(poses, distance, 0.03F * model.diameter_m, effort.kept);
  for (Scored& pose : poses) {
    pose.pose = refined(model, scene, pose.pose, {4, 150, 0.030F});
    pose.pose = refined(model, scene, pose.pose, {5, 400, 0.012F});
    pose.score = score(pose.pose, kFinePoints);
  }
  keep_best(poses, distance, 0.05F * model.diameter_m, max_candidates);
  std::vector<PoseCandidate> candidates;
  candidates.reserve(poses.size());
  for (Scored const& pose : poses) {
    candidates.push_back({pose.pose, verified(model, scene, pose.pose, {})});
  }
  std::ranges::stable_sort(candidates, std::greater{}, [](PoseCandidate const& candidate) {
    return candidate.verification.log_odds;
  });
  return candidates;
}

}  // namespace credo
