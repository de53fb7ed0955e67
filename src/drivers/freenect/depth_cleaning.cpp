#include "drivers/freenect/depth_cleaning.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace credo::freenect {

std::vector<std::uint16_t> false_depths_mm(std::span<std::uint16_t const> raw_to_mm) {
  std::vector<std::uint16_t> found;
  auto const infinite = std::ranges::find_if(
      raw_to_mm, [](std::uint16_t depth_mm) { return depth_mm >= kFarthest_mm; });
  std::copy_if(infinite, raw_to_mm.end(), std::back_inserter(found),
               [](std::uint16_t depth_mm) { return depth_mm != 0 && depth_mm < kFarthest_mm; });
  return found;
}

DepthCleaner::DepthCleaner(std::span<std::uint16_t const> false_depths_mm)
    : kept_mm_(kFarthest_mm + 1) {
  std::iota(kept_mm_.begin(), kept_mm_.end(), std::uint16_t{0});
  kept_mm_.back() = 0;
  for (std::uint16_t const depth_mm : false_depths_mm) {
    kept_mm_[std::min(depth_mm, kFarthest_mm)] = 0;
  }
}

void DepthCleaner::clean(std::span<std::uint16_t const> depths_mm,
                         std::span<std::uint16_t> cleaned) const {
  if (depths_mm.size() != cleaned.size()) {
    throw std::logic_error("DepthCleaner: room for " + std::to_string(cleaned.size()) + " of " +
                           std::to_string(depths_mm.size()) + " depths");
  }
  std::ranges::transform(depths_mm, cleaned.begin(), [this](std::uint16_t depth_mm) {
    return kept_mm_[std::min(depth_mm, kFarthest_mm)];
  });
}

}  // namespace credo::freenect
