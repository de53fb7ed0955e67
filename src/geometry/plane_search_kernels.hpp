#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/plane_search.hpp"

// Inner loops over the points of a plane search, compiled once per instruction set and chosen at
// run time; the same results on all of them.

namespace credo::plane_search {

/// A plane in single precision, as the inner loops use it.
struct FloatPlane {
  float normal_x, normal_y, normal_z, offset_m, min_cosine;

  FloatPlane(Plane const& plane, double max_angle_rad);
};

/// 1 where the point belongs to the plane, else 0. A NaN normal fails no comparison, so it passes.
[[nodiscard]] inline std::uint8_t belongs(FloatPlane const& plane, PlaneSearchPoints const& points,
                                          std::size_t i) {
  float const distance = plane.normal_x * points.x[i] + plane.normal_y * points.y[i] +
                         plane.normal_z * points.z[i] - plane.offset_m;
  float const cosine = plane.normal_x * points.normal_x[i] + plane.normal_y * points.normal_y[i] +
                       plane.normal_z * points.normal_z[i];
  bool const near = std::fabs(distance) <= points.tolerance_m[i];
  bool const turned = std::fabs(cosine) < plane.min_cosine;
  return near && !turned ? 1 : 0;
}

/// How many of the points belong to the plane, or no more than `to_beat` where it is no more.
[[nodiscard]] std::size_t count_belonging(FloatPlane const& plane, PlaneSearchPoints const& points,
                                          std::size_t to_beat);

/// How many of the points belong to the plane; for each 1 or 0 in `flags`.
std::size_t mark_belonging(FloatPlane const& plane, PlaneSearchPoints const& points,
                           std::span<std::uint8_t> flags);

}  // namespace credo::plane_search
