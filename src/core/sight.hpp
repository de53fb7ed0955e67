#pragma once

#include "core/cloud.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/label.hpp"
#include "core/se3.hpp"

namespace credo {

/// A frame as the belief looks at it: one value for each square block of its pixels, by which it
/// tells what was in sight from what was hidden.
struct Sight {
  /// Edge of a block.
  int block_px = 4;
  /// Of the frame itself, not of the blocks.
  CameraIntrinsics intrinsics;
  /// Along the optical axis, of each block's middle pixel; 0 where it has none.
  Grid<float> depth_m;
  /// The least depth in the block and the eight around it, which guards the edges of things against
  /// a pose that is not quite right; infinite where there is none.
  Grid<float> nearest_m;
  /// Of each block's middle pixel.
  LabelMap labels;
  /// Of each block's middle pixel; empty where nobody asks for them.
  NormalMap normals_camera;

  /// The frame's pixel in the middle of a block.
  [[nodiscard]] Pixel middle_of(Pixel block) const {
    return {block.u * block_px + block_px / 2, block.v * block_px + block_px / 2};
  }
};

/// A sight and from where it was.
struct PlacedSight {
  Sight sight;
  Se3 T_world_camera;
};

}  // namespace credo
