#pragma once

#include <array>
#include <cstddef>

#include "stages/normals/block_kernels.hpp"
#include "stages/normals/depth_tolerance.hpp"

namespace credo::normals {

/// Windows sample blocks at distances of 1, 2 and 4 blocks, the nearer the surface the wider.
inline constexpr std::size_t kLevels = 3;
/// A window has at most this many samples to each side; beyond, the next distance takes over.
inline constexpr int kMaxTaps = 4;
/// The widest half window that the three distances cover.
inline constexpr int kMaxRadiusPx = 2 * 4 * (kMaxTaps + 1);

/// What the fit needs to know besides the samples.
struct FitParams {
  DepthTolerance tolerance;
  /// Half window in pixels = radius_focal_m_px * w, at least min_radius_px, at most max_radius_px.
  float radius_focal_m_px = 0.0F;
  float min_radius_px = 0.0F;
  float max_radius_px = 0.0F;
  /// Least share of the window's samples that must be fitted.
  float min_support = 0.0F;
  // Pinhole camera.
  float fx_px = 0.0F;
  float fy_px = 0.0F;
  float cx_px = 0.0F;
  float cy_px = 0.0F;
};

/// One row of blocks for each sampling distance 2^i: levels[i] points to column 0, the next row is
/// `stride` further. Windows may reach kMaxTaps samples beyond the image, into kNothing.
struct LevelRows {
  std::array<float const*, kLevels> levels{};
  std::ptrdiff_t stride = 0;
};

/// Normals of one row of blocks, one per centre w (kNothing = none); NaN where the samples around
/// it do not carry a plane. Same rules as the block kernels. The method is told at
/// estimate_normals.
void fit_normals(LevelRows const& samples, int row, float const* centre_w, std::size_t count,
                 FitParams const& params, VectorRow const& normal);

}  // namespace credo::normals
