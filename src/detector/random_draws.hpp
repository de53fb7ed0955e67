#pragma once

#include <cstdint>

namespace credo {

/// Numbers that look random (SplitMix64: Steele, Lea and Flood 2014), the same on every machine, as
/// those of the standard library's distributions are not.
class RandomDraws {
public:
  explicit RandomDraws(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBULL;
    return mixed ^ (mixed >> 31U);
  }
  /// In [0, 1).
  float fraction() { return static_cast<float>(next() >> 40U) * 0x1.0p-24F; }
  /// In [0, 1).
  double fine_fraction() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

private:
  std::uint64_t state_;
};

}  // namespace credo
