#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"
#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

/// What holds a pose where the finest refinement has it, about the model's origin (boxplus in the
/// camera frame). Of errors e_i of what is measured the refinement makes the error
/// hold^-1 sum(w_i g_i e_i) of the pose, with weights w_i and gradients g_i: so much of it is known
/// of each kind of error.
struct PoseEvidence {
  /// sum(w g g'): how hard a small error of the pose is pulled back. Zero where nothing is.
  Matrix6d hold = Matrix6d::Zero();
  /// sum(w^2 d^2 g g'), d the deviation of each: the covariance of the pull by errors of the
  /// surface that have nothing in common, m^2, and of the silhouette.
  Matrix6d surface_noise = Matrix6d::Zero();
  Matrix6d edge_noise = Matrix6d::Zero();
  /// The pull by errors that all depths have in common, for each metre: all as much, or those
  /// at one end of the object more and at the other less, sideways and upright.
  Eigen::Matrix<double, 6, 3> common_depth = Eigen::Matrix<double, 6, 3>::Zero();
  /// The same of the silhouette: all of it farther out, or shifted sideways or upright.
  Eigen::Matrix<double, 6, 3> common_edge = Eigen::Matrix<double, 6, 3>::Zero();
  /// sum(g g' / d^2) of the surface and kEdgeInformation of the silhouette's: what all tell if
  /// errors have nothing in common.
  Matrix6d information = Matrix6d::Zero();
  /// Points of the surface that count.
  int points = 0;
  /// Of their residuals, in deviations, squared; 0 without any.
  double mean_squared_residual = 0.0;
  /// And of those of the silhouette.
  double mean_squared_edge_residual = 0.0;
};

/// Errors of the silhouette have more in common than those of surfaces: so many of its points are
/// worth one.
inline constexpr double kEdgeInformation = 0.3;

[[nodiscard]] PoseEvidence evidence_of(SearchModel const& model, SearchScene const& scene,
                                       CameraPose const& pose);

}  // namespace credo
