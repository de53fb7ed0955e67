#pragma once

#include <vector>

#include "core/plane.hpp"
#include "core/segments.hpp"
#include "geometry/plane_search.hpp"
#include "stages/planes/plane_view.hpp"

namespace credo {

/// Planes that may be floor or wall: of each segment those that are upright, and of all that is
/// near z = 0, in however small patches it is seen, those that are level. Camera frame; the one
/// with the most of all points in it first. A segment may have several, such as two walls that
/// meet, and coplanar segments have one each. What is tilted otherwise, such as a table's top,
/// costs no more than its few points here.
///
/// `sample` is spread evenly over the pixels, so many to a point; a point's source is its pixel.
[[nodiscard]] std::vector<Plane> segment_planes(PlaneView const& view, Segments const& segments,
                                                PlaneSearchPoints const& sample,
                                                double pixels_per_point);

}  // namespace credo
