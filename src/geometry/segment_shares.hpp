#pragma once

namespace credo {

// Of a segment's pixels, what an object, a floor or a wall must hold for all of it to be theirs,
// and up to what they hold none of it (docs/decisions/008).
inline constexpr double kMostlyShare = 0.6;
inline constexpr double kHardlyShare = 0.2;

}  // namespace credo
