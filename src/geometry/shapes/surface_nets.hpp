#pragma once

#include <span>

#include "core/object_model.hpp"
#include "geometry/shapes/oriented_point.hpp"

namespace credo {

/// A mesh through points of a surface whose normals point outward, which may be seen in part only,
/// and many times over with noise. Triangles turn counter-clockwise seen from outside. Where there
/// are no points within `spacing_m` there is no surface: the mesh of what was seen from one side is
/// open. Of several pieces those smaller than a twentieth of the largest are left out.
///
/// On a grid of edge `spacing_m` the distance to the surface is the weighted mean of the distances
/// to the planes of the points around that face like the nearest (Hoppe et al., SIGGRAPH 1992;
/// Kolluri, SODA 2005). Each cell through which it passes zero gets a vertex, in the mean of where
/// its edges are cut, and each edge that is cut a face of four (surface nets; Gibson, MICCAI 1998).
/// The grid is dense: 20 bytes for each cell of the box that holds the points.
[[nodiscard]] TriangleMesh surface_through(std::span<OrientedPoint const> points, float spacing_m);

}  // namespace credo
