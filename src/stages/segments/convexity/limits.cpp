#include "stages/segments/convexity/limits.hpp"

#include <algorithm>
#include <cmath>

namespace credo::segments {

Limits limits_for(double focal_px, SegmentsConfig const& config) {
  double const scale = focal_px / kReferenceFocal_px;
  auto const length_px = [&](double at_reference_px, int most_px) {
    auto const scaled = static_cast<int>(std::lround(at_reference_px * scale));
    return std::clamp(scaled, 1, most_px);
  };
  auto const area_px = [&](double at_reference_px) {
    double const scaled = std::round(at_reference_px * scale * scale);
    return static_cast<std::uint32_t>(std::clamp(scaled, 1.0, 1e9));
  };
  auto const units = [](double quanta) {
    return static_cast<std::int16_t>(std::lround(quanta * kUnitsPerQuantum));
  };
  Limits limits;
  limits.units_m = static_cast<float>(kUnitsPerQuantum / config.quantum_per_m);
  limits.link = units(config.link_quanta);
  limits.smooth = units(config.smooth_quanta);
  limits.smooth_radius_px = length_px(config.smooth_radius_px, kMaxSmooth_px);
  limits.reach_px = length_px(config.reach_px, kMaxReach_px);
  limits.diagonal_px = length_px(config.reach_px * std::sqrt(0.5), kMaxReach_px);
  limits.reach = units(config.reach_quanta);
  limits.far_weight =
      static_cast<std::int16_t>(std::min(std::lround(config.far_weight * 32768.0), 32767L));
  limits.crease = units(config.crease_quanta);
  limits.crease_noise = config.crease_noise;
  // The steepness is a difference across two reaches.
  limits.slope = static_cast<std::int16_t>(std::lround(config.crease_slope / 12.0 * 65536.0));
  limits.disc_px = length_px(config.disc_radius_px, kMaxDisc_px);
  limits.seed_px = area_px(4);
  limits.part_px = area_px(config.min_pixels);
  limits.small_px = area_px(1000);
  limits.border_px = area_px(400);
  return limits;
}

}  // namespace credo::segments
