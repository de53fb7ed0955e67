#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/object_model.hpp"
#include "geometry/shapes/solid_distance.hpp"

namespace credo {

/// Distances from points to a mesh, with its triangles in a tree (Embree), built once.
///
/// A closed mesh has an inside: the side is told by the angle-weighted pseudonormal of the nearest
/// face, edge or vertex, which is right for every point (Baerentzen and Aanaes 2005). An open mesh
/// has none: distances are never negative. Depth in doubles; the tree only narrows the search, so
/// the result is that of trying every triangle. Any number of threads may ask at once.
class MeshDistance {
public:
  /// Throws std::logic_error for a mesh without triangles, or one that names a vertex it lacks.
  explicit MeshDistance(TriangleMesh const& mesh);
  MeshDistance(MeshDistance const&) = delete;
  MeshDistance& operator=(MeshDistance const&) = delete;
  MeshDistance(MeshDistance&&) noexcept;
  MeshDistance& operator=(MeshDistance&&) noexcept;
  ~MeshDistance();

  /// Every edge has two triangles, which turn opposite ways along it.
  [[nodiscard]] bool closed() const;

  /// The normal is that of the nearest triangle; of equally near ones, the first. Throws
  /// std::logic_error for a point that is not finite.
  [[nodiscard]] SurfaceDistance operator()(Eigen::Vector3d const& point_model) const;

  /// Whether a triangle within `radius_m` of the point has its normal in the cone; of an open mesh,
  /// which may be seen from its back, its normal or the reverse. Throws std::logic_error for a
  /// point that is not finite.
  [[nodiscard]] bool has_face_near(Eigen::Vector3d const& point_model, double radius_m,
                                   DirectionCone const& cone) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace credo
