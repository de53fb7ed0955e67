#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/object_model.hpp"

namespace credo {

/// A way to lie on a flat table without falling over.
struct Rest {
  /// Model to a frame whose z is up.
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  /// Share, among the model's rests, of the area that it rests on.
  double share = 0.0;
};

/// Where the weight of a solid of even density acts, model frame. Of a mesh with holes about that;
/// parts that run into each other count twice where they do.
[[nodiscard]] Eigen::Vector3d centre_of_mass(TriangleMesh const& mesh);

/// Rests on the faces of the mesh's convex hull that its centre of mass can be over, but for those
/// from which a tilt of six degrees would throw it. Faces within two degrees of each other are one.
[[nodiscard]] std::vector<Rest> rests_of(TriangleMesh const& mesh);

}  // namespace credo
