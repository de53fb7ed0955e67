#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace credo::freenect {

/// Depths from here on, in millimetres, are no measurements: libfreenect clamps to this.
inline constexpr std::uint16_t kFarthest_mm = 10000;

/// Depths that no distance has: libfreenect's table from the sensor's raw values to millimetres
/// runs to infinity and comes back from below, cut to 16 bits, so that some raw values beyond
/// infinity look like good depths (6351 and 3755 mm at a Kinect's nominal calibration). These are
/// the values below kFarthest_mm, but 0, that the table takes after it has reached kFarthest_mm.
std::vector<std::uint16_t> false_depths_mm(std::span<std::uint16_t const> raw_to_mm);

/// Takes out of a depth image what is none.
class DepthCleaner {
public:
  DepthCleaner() : DepthCleaner(std::span<std::uint16_t const>()) {}
  explicit DepthCleaner(std::span<std::uint16_t const> false_depths_mm);

  /// Copies depths in millimetres: those from kFarthest_mm on and the false ones become 0.
  /// `cleaned` holds as many as `depths_mm`, else std::logic_error.
  void clean(std::span<std::uint16_t const> depths_mm, std::span<std::uint16_t> cleaned) const;

private:
  /// For each depth below kFarthest_mm, itself or 0; the last is for all others.
  std::vector<std::uint16_t> kept_mm_;
};

}  // namespace credo::freenect
