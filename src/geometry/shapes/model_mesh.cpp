#include "geometry/shapes/model_mesh.hpp"

#include <cstdint>
#include <variant>
#include <vector>

#include "geometry/shapes/outline.hpp"

namespace credo {

TriangleMesh mesh_of(ObjectModel const& model) {
  if (auto const* mesh = std::get_if<TriangleMesh>(&model.shape)) {
    return *mesh;
  }
  TriangleMesh joined;
  for (Solid const& solid : std::get<std::vector<Solid>>(model.shape)) {
    TriangleMesh const part = mesh_of(solid);
    auto const first = static_cast<std::uint32_t>(joined.vertices.size());
    joined.vertices.insert(joined.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (auto const& [a, b, c] : part.triangles) {
      joined.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return joined;
}

}  // namespace credo
