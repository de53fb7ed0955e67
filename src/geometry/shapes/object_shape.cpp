#include "geometry/shapes/object_shape.hpp"

#include <algorithm>
#include <stdexcept>

#include "geometry/shapes/solid.hpp"

namespace credo {

ObjectShape::ObjectShape(ObjectModel const& model) {
  if (auto const* solids = std::get_if<std::vector<Solid>>(&model.shape)) {
    if (solids->empty()) {
      throw std::logic_error("ObjectShape: model " + model.name + " is made of nothing");
    }
    for (Solid const& solid : *solids) {
      part_bounds_.push_back(bounds_of(solid));
      bounds_.extend(part_bounds_.back());
    }
    shape_ = *solids;
    return;
  }
  auto const& mesh = std::get<TriangleMesh>(model.shape);
  MeshDistance distance(mesh);
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    bounds_.extend(vertex.cast<double>());
  }
  part_bounds_ = {bounds_};
  closed_ = distance.closed();
  shape_ = std::move(distance);
}

SurfaceDistance ObjectShape::distance_to(Eigen::Vector3d const& point_model) const {
  if (auto const* mesh = std::get_if<MeshDistance>(&shape_)) {
    return (*mesh)(point_model);
  }
  auto const& solids = std::get<std::vector<Solid>>(shape_);
  SurfaceDistance least = credo::distance_to(solids.front(), point_model);
  for (std::size_t i = 1; i < solids.size(); ++i) {
    SurfaceDistance const other = credo::distance_to(solids[i], point_model);
    if (other.distance_m < least.distance_m) {
      least = other;
    }
  }
  return least;
}

bool ObjectShape::has_face_near(Eigen::Vector3d const& point_model, double radius_m,
                                DirectionCone const& cone) const {
  if (auto const* mesh = std::get_if<MeshDistance>(&shape_)) {
    return mesh->has_face_near(point_model, radius_m, cone);
  }
  return std::ranges::any_of(std::get<std::vector<Solid>>(shape_), [&](Solid const& solid) {
    return credo::has_face_near(solid, point_model, radius_m, cone);
  });
}

ObjectShapes shapes_of(ObjectModels const& models) {
  ObjectShapes shapes;
  for (auto const& [name, model] : models) {
    shapes.emplace(name, ObjectShape(model));
  }
  return shapes;
}

}  // namespace credo
