#include "detector/poses/pose_evidence.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "detector/poses/pose_pulls.hpp"
#include "detector/poses/pose_refinement.hpp"

namespace credo {
namespace {

double squared_deviations(PosePull const& pull) {
  float const in_deviations = pull.residual_m / pull.deviation_m;
  return static_cast<double>(in_deviations * in_deviations);
}

/// What one point adds; `common_errors` are what the kinds of errors in common do to it.
struct Share {
  Vector6d gradient;
  double weight = 0.0;
  double deviation_m = 0.0;
  Eigen::Vector3d common_errors;

  Share(PosePull const& pull, Eigen::Vector3f const& origin, Eigen::Vector3f const& errors)
      : gradient(pull.gradient(origin).cast<double>()),
        weight(static_cast<double>(pull.weight)),
        deviation_m(static_cast<double>(pull.deviation_m)),
        common_errors(errors.cast<double>()) {}

  [[nodiscard]] Matrix6d hold() const { return weight * gradient * gradient.transpose(); }
  [[nodiscard]] Matrix6d noise() const { return weight * deviation_m * deviation_m * hold(); }
  [[nodiscard]] Matrix6d information() const { return hold() / (deviation_m * deviation_m); }
  [[nodiscard]] Eigen::Matrix<double, 6, 3> common() const {
    return weight * gradient * common_errors.transpose();
  }
};

}  // namespace

PoseEvidence evidence_of(SearchModel const& model, SearchScene const& scene,
                         CameraPose const& pose) {
  Eigen::Vector3f const centre = pose * model.centre_model;
  ModelView const& view = model.view_from(-(pose.rotation.transpose() * centre));
  Eigen::Vector3f const ray = centre.normalized();
  Eigen::Vector3f const sideways = ray.cross(Eigen::Vector3f::UnitY()).normalized();
  Eigen::Vector3f const upright = ray.cross(sideways);
  PoseEvidence evidence;
  auto const on_surface = [&](PosePull const& pull) {
    // What a longer depth does along the normal.
    float const slant = pull.direction_camera.dot(pull.point_camera.normalized());
    Eigen::Vector3f const place = (pull.point_camera - centre) / model.radius_m;
    Share const share(pull, pose.translation_m,
                      slant * Eigen::Vector3f(1.0F, place.dot(sideways), place.dot(upright)));
    evidence.hold += share.hold();
    evidence.surface_noise += share.noise();
    evidence.common_depth += share.common();
    evidence.information += share.information();
    evidence.mean_squared_residual += squared_deviations(pull);
  };
  int edges = 0;
  auto const on_edge = [&](PosePull const& pull) {
    Share const share(
        pull, pose.translation_m,
        {1.0F, pull.direction_camera.dot(sideways), pull.direction_camera.dot(upright)});
    evidence.hold += share.hold();
    evidence.edge_noise += share.noise();
    evidence.common_edge += share.common();
    evidence.information += kEdgeInformation / share.weight * share.information();
    evidence.mean_squared_edge_residual += squared_deviations(pull);
    ++edges;
  };
  evidence.points = visit_pulls(model, scene, pose, view, kFinestRefinement, on_surface, on_edge);
  evidence.mean_squared_residual /= std::max(1, evidence.points);
  evidence.mean_squared_edge_residual /= std::max(1, edges);
  return evidence;
}

}  // namespace credo
