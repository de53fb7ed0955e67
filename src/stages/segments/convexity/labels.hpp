#pragma once

#include <cstdint>

#include "stages/segments/convexity/limits.hpp"
#include "stages/segments/convexity/surface_map.hpp"
#include "stages/segments/padded_grid.hpp"

namespace credo::segments {

/// 0 where there is none yet.
using PartLabels = PaddedGrid<std::int32_t>;

/// Parts of the image without a crease or a jump inside, from the thickest (4) over the middle (2)
/// to the thinnest (1): a leak through a gap in a crease is thin, and is closed before anything
/// flows through it. Then what is left goes to what it touches, least concave first. Every pixel
/// with depth that is joined to a part gets its label; labels count from 1.
///
/// Fronts advance together, a pixel at a time: first all pixels that have a label beside them, in
/// the order of the raster, each from the first of these; then each from those before it, to the
/// left, to the right, up, down.
[[nodiscard]] PartLabels grow_parts(SurfaceMap const& map, Limits const& limits);

}  // namespace credo::segments
