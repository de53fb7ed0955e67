#pragma once

#include <cstdint>

#include "drivers/virtual/sensor_script.hpp"

namespace credo {

/// The next of a chain of numbers that look random (SplitMix64: Steele, Lea and Flood 2014); moves
/// the state on.
inline std::uint64_t next_random(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15ULL;
  std::uint64_t mixed = state;
  mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9ULL;
  mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBULL;
  return mixed ^ (mixed >> 31);
}

/// The same number for the same seed, tick and stream, whatever was asked before.
inline std::uint64_t seeded(std::uint64_t seed, std::int64_t tick, SensorStream stream) {
  std::uint64_t state = seed;
  state = next_random(state) + 2 * static_cast<std::uint64_t>(tick) +
          (stream == SensorStream::kColor ? 1 : 0);
  return next_random(state);
}

/// In [0, 1).
inline double fraction_of(std::uint64_t random) {
  return static_cast<double>(random >> 11) * 0x1.0p-53;
}

}  // namespace credo
