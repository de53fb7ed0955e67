#pragma once

#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/segments.hpp"

namespace credo {

/// Takes flat and thin things off what they lie on: a magazine or a pen on a table, a cable before
/// a wall. They are too low to have a crease around them and too thin to have an inside.
///
/// A convex surface is nowhere in front of the planes of its faces. So in a large segment that is
/// mostly flat, what stands out by `raised_quanta` of inverse depth (or several times the surface's
/// own noise, if that is more), as far as it stands out by more than half of that, is a thing of
/// its own if it is large enough (`raised_min_pixels`) and lies on that segment all around; what is
/// along a crease is the crease's. The flat surface may be bent a little, as sensors bend it.
///
/// The new segments come after the others, in raster order; `lies_on` names the one that each was
/// taken from. A tenth of a quantum's change of depth may move their borders by pixels, but the
/// same input gives the same bytes.
[[nodiscard]] Segments with_raised_things(Segments segments, Grid<float> const& depth_m,
                                          double focal_px, SegmentsConfig const& config);

}  // namespace credo
