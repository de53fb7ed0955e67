#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Inner loops of a depth registration, compiled once per instruction set and chosen at run time;
// the same results on all of them.

namespace credo::depth_registration {

/// Neighbours are one surface where their depths differ by no more than this share.
inline constexpr float kSameSurface = 0.03F;

/// A depth pixel (u, v) at z is at z * turn * (u, v, 1) + shift in the colour image, homogeneous.
struct Warp {
  Eigen::Matrix3f turn;
  Eigen::Vector3f shift;
  /// Half a depth pixel in the colour image, for equal depths.
  Eigen::Array2f half_px;
  /// How far the corners of a turned pixel reach beyond that.
  Eigen::Array2f corner_px;
};

/// A row of pixels and where the colour camera sees them; NaN where there is no depth. There is one
/// pixel more before the first, and some after the last, all without depth: so every pixel has
/// neighbours, and vectors may run over.
struct ProjectedRow {
  explicit ProjectedRow(std::size_t width);

  std::vector<float> z_m;  // of the depth camera
  std::vector<float> u_px, v_px;
  std::vector<float> depth_m;  // of the colour camera
};

/// The pixels of the colour image in each pixel's footprint: the first, and how many columns and
/// rows; none where there is no depth.
struct Footprints {
  explicit Footprints(std::size_t width);

  std::vector<std::int32_t> u, v, columns, rows;
};

void project(std::span<float const> depth_m, int v, Warp const& warp, ProjectedRow& row);

void find_footprints(ProjectedRow const& above, ProjectedRow const& row, ProjectedRow const& below,
                     Warp const& warp, Eigen::Array2f const& size_px, Footprints& footprints);

}  // namespace credo::depth_registration
