#pragma once

#include <cstddef>
#include <vector>

#include "detector/scenes/facets.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

/// Points of each segment that have a normal, of every third pixel of every third row.
using SegmentPoints = std::vector<std::vector<OrientedPoint>>;

[[nodiscard]] SegmentPoints points_of_segments(SearchScene const& scene, std::size_t segment_count);

/// The planes that most of a large segment lies on, largest segment first. What else a segment
/// holds, such as things that it runs into, does not count.
[[nodiscard]] std::vector<ScenePlane> large_planes(SegmentPoints const& points,
                                                   std::size_t image_pixels);

/// Says of each pixel which of the scene's planes it is of: the first that it lies on, which is its
/// own segment's, or one that goes on through other segments where it turns the same way.
void mark_planes(SearchScene& scene);

/// Makes segments of their own of what stands on a plane and runs into its segment: connected
/// pixels off the plane. What has too few stays. Returns how many segments there are then.
[[nodiscard]] std::size_t split_from_planes(SearchScene& scene, std::size_t segment_count);

}  // namespace credo
