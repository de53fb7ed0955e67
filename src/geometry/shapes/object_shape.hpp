#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/object_model.hpp"
#include "geometry/shapes/mesh_distance.hpp"
#include "geometry/shapes/solid_distance.hpp"

namespace credo {

/// The shape of a model, made ready to be asked. Model frame throughout; any number of threads.
class ObjectShape {
public:
  /// Throws std::logic_error for an empty shape.
  explicit ObjectShape(ObjectModel const& model);

  /// Whether it has an inside: solids always, a mesh where it is closed.
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] Eigen::AlignedBox3d const& bounds() const { return bounds_; }
  /// Boxes that together hold it: one for each solid, or one for the mesh. Never empty.
  [[nodiscard]] std::vector<Eigen::AlignedBox3d> const& part_bounds() const { return part_bounds_; }
  /// Of solids, the least of their distances: exact outside and on the surface of their union, and
  /// negative inside it.
  [[nodiscard]] SurfaceDistance distance_to(Eigen::Vector3d const& point_model) const;
  /// Whether a face within `radius_m` of the point has its normal in the cone: at a crease that is
  /// more than the nearest one. Of solids each by itself, also where it lies within another; an
  /// open mesh may be seen from its back.
  [[nodiscard]] bool has_face_near(Eigen::Vector3d const& point_model, double radius_m,
                                   DirectionCone const& cone) const;

private:
  std::variant<std::vector<Solid>, MeshDistance> shape_;
  Eigen::AlignedBox3d bounds_;
  std::vector<Eigen::AlignedBox3d> part_bounds_;
  bool closed_ = true;
};

/// By the name of their model.
using ObjectShapes = std::map<std::string, ObjectShape>;

[[nodiscard]] ObjectShapes shapes_of(ObjectModels const& models);

}  // namespace credo
