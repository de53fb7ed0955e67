#pragma once

#include <vector>

#include "core/plane.hpp"
#include "core/segments.hpp"
#include "geometry/plane_search.hpp"
#include "stages/planes/plane_view.hpp"

namespace credo {

/// The planes that segments are made of, as far as they may be floor or wall: upright, or level and
/// near z = 0; and where the level of the world is known, z = 0 itself. Camera frame; the one with
/// the most of all points in it first, whatever their segment. A segment may have several, such as
/// two walls that meet, and coplanar segments have one each. What is tilted otherwise, such as a
/// table's top, costs no more than its few points here.
///
/// `sample` is spread evenly over the pixels, so many to a point; a point's source is its pixel.
[[nodiscard]] std::vector<Plane> segment_planes(PlaneView const& view, Segments const& segments,
                                                PlaneSearchPoints const& sample,
                                                double pixels_per_point);

}  // namespace credo
