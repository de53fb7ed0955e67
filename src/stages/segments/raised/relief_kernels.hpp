#pragma once

#include <cstddef>
#include <cstdint>

// Kernels on rows of floats, compiled once per instruction set and chosen at run time. Each pixel
// for itself and without fused multiply-add: the bytes are the same on every machine.

namespace credo::segments {

/// A surface along a row, and how what stands out of it is measured.
struct SurfaceRow {
  /// Its quanta of inverse depth: at_middle + x (slope + x bend).
  float at_middle = 0.0F;
  float slope = 0.0F;
  float bend = 0.0F;
  /// Where the first pixel is, and how far each next one.
  float first_x = 0.0F;
  float step_x = 0.0F;
  /// One over a quantum [m].
  float quanta_m = 0.0F;
  /// So much of a height is a quantum; heights are at most so far from 0.
  float share = 0.0F;
  float farthest = 0.0F;
};

/// Heights of pixels side by side over a surface. Reads no more than `count` depths; up to 16 more
/// heights are written.
void height_row(float const* depth_m, SurfaceRow const& surface, std::size_t count, float* heights);

/// Of each value itself and those beside it together. Reads and writes up to 16 more.
void sum_row(float const* values, std::size_t count, float* sums);

/// Of each pixel of a row: the segment whose surface is there, 0 for none, and of itself and those
/// beside it that have the same, how many and their heights together. Of up to 16 pixels more than
/// there are something must be there.
struct SumsRow {
  std::int32_t const* surface = nullptr;
  float const* sums = nullptr;
  float const* counts = nullptr;
};

/// The mean over those of three rows that have the surface of the middle one; 0 where that has
/// none. Up to 16 more are written.
void mean_row(SumsRow const& above, SumsRow const& here, SumsRow const& below, std::size_t count,
              float* means);

}  // namespace credo::segments
