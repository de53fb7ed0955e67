#include "sim/thing.hpp"

#include <variant>

#include "geometry/shapes/solid.hpp"

namespace credo {

std::vector<Solid> solids_of(SceneThing const& thing) {
  if (thing.loaded_model != nullptr) {
    auto const* solids = std::get_if<std::vector<Solid>>(&thing.loaded_model->shape);
    return solids != nullptr ? *solids : std::vector<Solid>{};
  }
  std::vector<double> const& s = thing.size_m;
  switch (thing.shape) {
    case SceneShape::kBox:
      return {box_on_base({s[0], s[1], s[2]})};
    case SceneShape::kCylinder:
      return {CylinderSolid{s[0], s[1]}};
    case SceneShape::kSphere:
      return {SphereSolid{s[0]}};
    case SceneShape::kTable:
      return table_on_base({{s[0], s[1]}, s[2], s[3], s[4]});
  }
  return {};
}

TriangleMesh const* mesh_of(SceneThing const& thing) {
  return thing.loaded_model != nullptr ? std::get_if<TriangleMesh>(&thing.loaded_model->shape)
                                       : nullptr;
}

SceneTexture texture_of(SceneThing const& thing) {
  return thing.checker_m > 0.0 ? SceneTexture{SceneTexture::Kind::kChecker, thing.checker_m}
                               : thing.texture;
}

Eigen::AlignedBox3d bounds_of_thing(SceneThing const& thing) {
  Eigen::AlignedBox3d box;
  if (TriangleMesh const* mesh = mesh_of(thing); mesh != nullptr) {
    for (Eigen::Vector3f const& vertex : mesh->vertices) {
      box.extend(vertex.cast<double>());
    }
  }
  for (Solid const& solid : solids_of(thing)) {
    box.extend(bounds_of(solid));
  }
  return box;
}

std::string const& type_of(SceneThing const& thing) {
  if (!thing.type.empty()) {
    return thing.type;
  }
  return thing.loaded_model != nullptr ? thing.loaded_model->name : thing.name;
}

Se3 pose_of(SceneThing const& thing) {
  return {rotation_of_rpy_deg({thing.rpy_deg[0], thing.rpy_deg[1], thing.rpy_deg[2]}),
          {thing.position_m[0], thing.position_m[1], thing.position_m[2]}};
}

}  // namespace credo
