#pragma once

#include <cstdint>

#include "stages/segments/padded_grid.hpp"
#include "stages/segments/segments.hpp"

namespace credo::segments {

/// Inverse depth is counted in sixteenths of a quantum: fine enough to smooth, and 0.17 m still
/// fits sixteen bits.
inline constexpr int kUnitsPerQuantum = 16;

/// Of images with more pixels to a radian no more is looked at: the sums of a window of that
/// radius, of differences of up to 7 quanta, fit sixteen bits.
inline constexpr int kMaxSmooth_px = 8;
inline constexpr int kMaxReach_px = 32;
inline constexpr int kMaxDisc_px = 255;
static_assert(2 * kMaxReach_px <= PaddedGrid<int>::kMargin);

/// The config for one camera: pixels scaled to its focal length, heights in units.
struct Limits {
  /// Units of inverse depth: this over metres.
  float units_m = 0.0F;
  std::int16_t link = 0;
  std::int16_t smooth = 0;
  int smooth_radius_px = 0;
  int reach_px = 0;
  int diagonal_px = 0;
  std::int16_t reach = 0;
  /// Of concavity over twice the reach, over 2^15.
  std::int16_t far_weight = 0;
  int crease = 0;
  double crease_noise = 0.0;
  /// Of a steepness in units between points two reaches apart, the part that a crease must exceed;
  /// over 2^16.
  std::int16_t slope = 0;
  int disc_px = 0;
  std::uint32_t seed_px = 0;
  std::uint32_t part_px = 0;
  /// Segments below this join more easily.
  std::uint32_t small_px = 0;
  /// Borders between segments below this stay as they are.
  std::uint32_t border_px = 0;
};

[[nodiscard]] Limits limits_for(double focal_px, SegmentsConfig const& config);

}  // namespace credo::segments
