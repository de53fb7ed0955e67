#pragma once

#include <cstddef>
#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"

// A corner of a room that is known exactly, and frames of it.
namespace credo::test {

/// A box on the floor, its edges along the world's. Stuff.
struct Crate {
  Eigen::Vector3d min_m;
  Eigen::Vector3d max_m;
};

struct DriftRoom {
  bool floor = true;
  /// Of the two walls, at x = 4 and at y = 2.
  std::size_t walls = 2;
  std::vector<Crate> crates;
};

/// Crates of different sizes, all turned like the world, as many as asked for, at most 6.
std::vector<Crate> crates(std::size_t count);

/// Looks into the corner, down on the floor. Optical frame.
Se3 looking_into_the_corner();

/// 160 x 120 pixels at 130 px; where nothing is hit there is no depth. Blocks of one pixel, with
/// the normals of what they hit. `told`: where the frame says that the camera stands.
Segmentation frame_of(DriftRoom const& room, Se3 const& T_world_camera, Se3 const& T_told_camera);

/// All that a frame from there shows of the room, believed firmly, where it truly is.
BeliefState belief_of(DriftRoom const& room, Se3 const& T_world_camera);

}  // namespace credo::test
