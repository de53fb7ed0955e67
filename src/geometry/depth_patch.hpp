#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"

namespace credo {

/// Where a patch has no surface.
inline constexpr float kNoSurface_m = std::numeric_limits<float>::infinity();

/// Part of a depth image, as large as what was rendered into it.
struct DepthPatch {
  /// Of its top left pixel, in the image.
  Pixel corner;
  /// Along the optical axis; kNoSurface_m where the ray meets nothing. May be empty.
  Grid<float> depth_m;
};

/// The size of a camera's image.
struct ImageSize {
  int width_px = 640;
  int height_px = 480;
};

/// Those triangles that turn counter-clockwise as the camera sees them.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> facing_camera(
    std::span<Eigen::Vector3f const> vertices_camera,
    std::span<std::array<std::uint32_t, 3> const> triangles);

/// The depth of triangles, seen from either side, at the centres of pixels: the nearest at each,
/// exact to the rounding of floats (in inverse depth a triangle is affine in the image). A triangle
/// with a corner nearer to the camera's plane than 1 cm is left out. The patch is the least that
/// holds what lies in the image; empty where that is nothing.
[[nodiscard]] DepthPatch render_depth(std::span<Eigen::Vector3f const> vertices_camera,
                                      std::span<std::array<std::uint32_t, 3> const> triangles,
                                      CameraIntrinsics const& intrinsics, ImageSize size);

}  // namespace credo
