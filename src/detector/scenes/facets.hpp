#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geometry/shapes/oriented_point.hpp"

namespace credo {

/// A flat piece of a surface, bounded by a rectangle.
struct Facet {
  /// Unit, away from the solid.
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();
  /// Unit, along the longer side; the shorter runs along normal x along.
  Eigen::Vector3f along = Eigen::Vector3f::UnitX();
  float half_length_m = 0.0F;
  float half_width_m = 0.0F;
  /// Points that it was found by, and of a scene the segment that they are of.
  std::size_t points = 0;
  std::uint16_t segment = 0;

  [[nodiscard]] Eigen::Vector3f across() const { return normal.cross(along); }
};

/// The flat pieces of a surface, those with the most points first: points whose normals agree
/// within 18 degrees and that lie within `tolerance_m` of one plane, and are at least `min_share`
/// of all and `min_points`. At most 6.
[[nodiscard]] std::vector<Facet> facets_of(std::vector<OrientedPoint> points, float tolerance_m,
                                           float min_share, std::size_t min_points);

}  // namespace credo
