#include "detector/poses/pose_refinement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "detector/poses/pose_pulls.hpp"

namespace credo {
namespace {

using Matrix6f = Eigen::Matrix<float, 6, 6>;

/// Where points say nothing of a direction, no step is taken along it.
constexpr float kDamping = 1e-3F;

/// The normal equations of one step.
struct Equations {
  Matrix6f information = Matrix6f::Zero();
  Vector6f pull = Vector6f::Zero();
  int pulls = 0;

  void add(Vector6f const& row, float residual_m, float weight) {
    information.noalias() += weight * row * row.transpose();
    pull += weight * residual_m * row;
    ++pulls;
  }
};

CameraPose moved(CameraPose const& pose, Eigen::Vector3f const& centre, Vector6f const& step) {
  Eigen::Vector3f const phi = step.tail<3>();
  float const angle = phi.norm();
  Eigen::Matrix3f const turn = angle > 0.0F
                                   ? Eigen::AngleAxisf(angle, phi / angle).toRotationMatrix()
                                   : Eigen::Matrix3f(Eigen::Matrix3f::Identity());
  return {turn * pose.rotation, turn * (pose.translation_m - centre) + centre + step.head<3>()};
}

}  // namespace

CameraPose refined(SearchModel const& model, SearchScene const& scene, CameraPose const& start,
                   RefinementConfig const& config) {
  CameraPose pose = start;
  Eigen::Vector3f const first_centre = pose * model.centre_model;
  ModelView const& view = model.view_from(-(pose.rotation.transpose() * first_centre));
  float const length_m = model.radius_m;
  for (int iteration = 0; iteration < config.iterations; ++iteration) {
    Eigen::Vector3f const centre = pose * model.centre_model;
    Equations equations;
    auto const add = [&](PosePull const& pull) {
      equations.add(pull.gradient(centre), pull.residual_m, pull.weight);
    };
    int const on_surface = visit_pulls(model, scene, pose, view, config, add, add);
    if (on_surface < kFewestSurfacePulls) {
      return pose;
    }
    float const damping = kDamping * static_cast<float>(equations.pulls);
    Matrix6f& information = equations.information;
    information.diagonal().head<3>().array() += damping;
    information.diagonal().tail<3>().array() += damping * length_m * length_m;
    Vector6f const step = information.ldlt().solve(equations.pull);
    if (!step.allFinite()) {
      return pose;
    }
    pose = moved(pose, centre, step);
  }
  // Products of rotations in floats drift.
  pose.rotation = Eigen::Quaternionf(pose.rotation).normalized().toRotationMatrix();
  return pose;
}

}  // namespace credo
