#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/object_model.hpp"

namespace credo {

struct SurfaceSample {
  std::vector<Eigen::Vector3f> points;
  /// Unit, of the triangles, evened out over twice the spacing where they do not turn by more than
  /// 60 degrees.
  std::vector<Eigen::Vector3f> normals;
  float area_m2 = 0.0F;
};

/// Points on a mesh, no two nearer than `spacing_m`, in random order (by dart throwing: Poisson
/// disc). Fewer than one for each spacing squared of area, and more than half of that.
[[nodiscard]] SurfaceSample sample_surface(TriangleMesh const& mesh, float spacing_m,
                                           std::uint64_t seed);

/// Positions of points, no two nearer than `spacing_m`; first come, first kept.
[[nodiscard]] std::vector<std::uint32_t> apart(std::vector<Eigen::Vector3f> const& points,
                                               float spacing_m);

}  // namespace credo
