#pragma once

#include <cstdint>

#include "core/cloud.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"
#include "stages/normals/normals.hpp"

namespace credo::test {

/// What estimate_normals says, by its definition: every pixel for itself, sums in double.
struct LiteralNormals {
  NormalMap normals;
  /// 1 where a comparison of fitted values is so close that rounding decides it: there the fast
  /// version may come out on the other side.
  Grid<std::uint8_t> undecided;
};

/// The slow twin of estimate_normals. Which samples belong to a window is decided in float, as it
/// is there; everything after is computed in double.
LiteralNormals literal_normals(Grid<float> const& depth_m, CameraIntrinsics const& intrinsics,
                               NormalsConfig const& config);

}  // namespace credo::test
