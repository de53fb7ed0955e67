#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// Kernels on one row, compiled once per instruction set and chosen at run time. All but the
// division of the depths is in whole numbers: the bytes are the same on every machine. Rows are
// those of a PaddedGrid: pixels around them may be read, and up to 64 beyond `count` written.

namespace credo::segments {

/// Inverse depth in units, rounded; 0 where the depth is invalid. Depths that are too near to fit
/// count as the nearest that does.
void disparity_row(float const* depth_m, std::size_t count, float units_m, std::int16_t* out);

/// Of each pixel the mean over the square around it of those that differ by less than `limit`;
/// rounded half to even. 0 stays 0.
void smooth_row(std::int16_t const* centre, std::ptrdiff_t stride, int radius, std::int16_t limit,
                std::size_t count, std::int16_t* out);

/// Where the pairs of concavity_row lie.
struct ConcavityPairs {
  std::array<std::ptrdiff_t, 4> offsets;
  /// Both differ from the centre by less.
  std::int16_t limit = 0;
  /// Of the pairs at twice the offsets, over 2^15.
  std::int16_t far_weight = 0;
};

/// Of each pixel c, over the pairs a, b at plus and minus each offset: `concavity` is the largest
/// a + b - 2c, or 0, `steepness` the largest |a - b|. Pairs count where neither is 0 and both are
/// within the limit. At twice the offsets concavity is weighted, rounded down, and steepness left
/// out.
void concavity_row(std::int16_t const* centre, ConcavityPairs const& pairs, std::size_t count,
                   std::int16_t* concavity, std::int16_t* steepness);

/// `wall`: 1 where valid and concave by more than `crease` plus slope / 2^16 of the steepness,
/// rounded down. `solid`: 1 where valid, no wall, and none of the four neighbours is valid and
/// differs by `link` or more.
struct CreaseLimits {
  std::int16_t crease = 0;
  std::int16_t slope = 0;
  std::int16_t link = 0;
};
void crease_row(std::int16_t const* disparity, std::ptrdiff_t stride, std::int16_t const* concavity,
                std::int16_t const* steepness, CreaseLimits const& limits, std::size_t count,
                std::uint8_t* wall, std::uint8_t* solid);

/// One more than `level` where all of the 3x3 pixels around are `level` or more and the centre is;
/// else the centre.
void thicken_row(std::uint8_t const* centre, std::ptrdiff_t stride, std::uint8_t level,
                 std::size_t count, std::uint8_t* out);

/// 1 more than the thickness where valid, else 0.
void worth_row(std::int16_t const* disparity, std::uint8_t const* thickness, std::size_t count,
               std::uint8_t* out);

/// What a flood asks of a pixel, in a byte. The lowest six bits: 0 where there is no worth, else
/// one more than its concavity in half quanta, rounded down, 62 at most. kLinkedRight and
/// kLinkedDown where the disparity differs by less than `link` from the next pixel's, and from the
/// next row's.
inline constexpr std::uint8_t kFloodCost = 63;
inline constexpr std::uint8_t kLinkedRight = 64;
inline constexpr std::uint8_t kLinkedDown = 128;
void flood_row(std::uint8_t const* worth, std::int16_t const* disparity, std::ptrdiff_t stride,
               std::int16_t const* concavity, std::int16_t link, std::size_t count,
               std::uint8_t* out);

// Bits: one a pixel, 64 a word, as many words as `count` needs; those beyond it are 0.

/// 1 where a value is at least that.
void at_least_bits(std::uint8_t const* row, std::uint8_t least, std::size_t count,
                   std::uint64_t* out);

/// 1 where a value is higher.
void higher_bits(float const* row, float than, std::size_t count, std::uint64_t* out);

/// 1 where the centre is `least` or more and one of its four neighbours 0.
void front_bits(std::uint8_t const* centre, std::ptrdiff_t stride, std::uint8_t least,
                std::size_t count, std::uint64_t* out);

}  // namespace credo::segments
