#pragma once

#include <Eigen/Core>

#include "core/object_model.hpp"

namespace credo::test {

/// A closed, wavy, torus-like mesh about z: far from convex, faces of many sizes.
TriangleMesh wavy_ring(int around, int across);

/// The distance of a point to a mesh by trying every triangle; its sign by counting the triangles
/// that rays through it cross, of three odd directions the majority.
double literal_mesh_distance(TriangleMesh const& mesh, Eigen::Vector3d const& point);

/// Where a ray first meets a mesh, in lengths of its direction, by trying every triangle; infinite
/// where it misses.
double literal_mesh_hit(TriangleMesh const& mesh, Eigen::Vector3d const& origin,
                        Eigen::Vector3d const& direction);

}  // namespace credo::test
