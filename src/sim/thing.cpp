#include "sim/thing.hpp"

namespace credo {

std::vector<Solid> solids_of(SceneThing const& thing) {
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

std::string const& type_of(SceneThing const& thing) {
  return thing.type.empty() ? thing.name : thing.type;
}

Se3 pose_of(SceneThing const& thing) {
  return {rotation_of_rpy_deg({thing.rpy_deg[0], thing.rpy_deg[1], thing.rpy_deg[2]}),
          {thing.position_m[0], thing.position_m[1], thing.position_m[2]}};
}

}  // namespace credo
