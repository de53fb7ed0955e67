#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/object_model.hpp"

namespace credo {

using NormalCloud = pcl::PointCloud<pcl::PointNormal>;

/// What all baselines know of a model.
struct ModelCloud {
  std::string name;
  Symmetry symmetry;
  /// Its surface in random order, outward normals, model frame; points of one side of a wall are
  /// about so far apart.
  NormalCloud::Ptr points;
  double diameter_m = 0.0;
};

/// The same for the same model.
[[nodiscard]] ModelCloud model_cloud(ObjectModel const& model, double spacing_m);

/// The first `count` points and the cloud as it is.
[[nodiscard]] NormalCloud::Ptr first_points(NormalCloud const& points, std::size_t count);

/// The points whose normals are turned to a camera at the origin, when the model stands at a pose.
/// What hides them is not asked.
[[nodiscard]] NormalCloud::Ptr facing_points(NormalCloud const& points,
                                             Eigen::Isometry3f const& pose_camera);

/// Turns that are at least so far from each other and, together, near to every turn, a model's
/// symmetry left out.
[[nodiscard]] std::vector<Eigen::Quaternionf> spread_turns(Symmetry const& symmetry,
                                                           double apart_deg);

}  // namespace credo
