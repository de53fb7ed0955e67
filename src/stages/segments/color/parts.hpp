#pragma once

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/segments.hpp"

namespace credo {

/// Parts things in flush contact, which have no crease between them, where their colours differ: a
/// segment of two or three colours is cut by planes that have one of them on one side (color_cut).
/// Geometry stays in charge: nothing is cut but what is flat on both sides of the cut, and no
/// furniture, floor or wall. Prints, patterns, light and shade, dark and grey cut nothing.
///
/// `segments` are those of `convex_segments` for that depth; the result is numbered like them.
/// `color` must be registered to depth. Without (another size, or empty) nothing happens, nor with
/// `color_apart` = 0. A box of two plain colours with a straight border from edge to edge is the
/// mistake that is left.
[[nodiscard]] Segments split_by_color(Segments segments, Grid<float> const& depth_m,
                                      Grid<Rgb> const& color, double focal_px,
                                      SegmentsConfig const& config);

}  // namespace credo
