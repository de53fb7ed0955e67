#pragma once

#include <cmath>
#include <vector>

#include "doctor/stream_timing.hpp"

namespace credo::test {

/// Each comes 10 ms after it was taken.
inline std::vector<ImageTime> image_times(double rate_hz, int count) {
  std::vector<ImageTime> images;
  for (int i = 0; i < count; ++i) {
    std::int64_t const time_ns = std::llround(1e9 * i / rate_hz);
    images.push_back(
        {1'000'000'000 + time_ns,
         std::chrono::steady_clock::time_point(std::chrono::nanoseconds(50'010'000'000 + time_ns)),
         i});
  }
  return images;
}

inline std::vector<ImageTime> shifted(std::vector<ImageTime> images, double by_ms) {
  for (ImageTime& image : images) {
    image.stamp_ns += std::llround(1e6 * by_ms);
  }
  return images;
}

}  // namespace credo::test
