#include "drivers/freenect/clock.hpp"

#include <cstdlib>

namespace credo::freenect {
namespace {

constexpr std::int64_t kTicksPerMicrosecond = 60;
constexpr std::int64_t kTicksPerSecond = 60'000'000;
constexpr std::int64_t kWrap = std::int64_t{1} << 32;
/// Depth and colour overtake each other by less than a few frames.
constexpr std::int64_t kMostBack = 1 * kTicksPerSecond;
/// A busy host takes stamps late; no later than this.
constexpr std::int64_t kMostOff = 10 * kTicksPerSecond;

/// Of all steps that lead from one stamp to the other, the one nearest to the expected one.
std::int64_t nearest_step(std::uint32_t from, std::uint32_t to, std::int64_t expected) {
  auto const shortest = std::int64_t{to} - std::int64_t{from};
  std::int64_t const over = expected - shortest;
  std::int64_t const half = over >= 0 ? kWrap / 2 : -kWrap / 2;
  return shortest + (over + half) / kWrap * kWrap;
}

}  // namespace

std::uint64_t ClockUnwrapper::unwrap_us(std::uint32_t stamp, std::int64_t host_us) {
  if (!anchor_) {
    anchor_ = {stamp, stamp, host_us};
  }
  std::int64_t const expected = (host_us - anchor_->host_us) * kTicksPerMicrosecond;
  std::int64_t step = nearest_step(anchor_->stamp, stamp, expected);
  bool const contradicts = step < -kMostBack || std::abs(step - expected) > kMostOff;
  if (contradicts) {
    step = expected;
  }
  std::int64_t const ticks = anchor_->ticks + step;
  if (contradicts || step > 0) {
    anchor_ = {stamp, ticks, host_us};
  }
  // Nothing is before the origin, not even the other stream's first stamp.
  return static_cast<std::uint64_t>(ticks > 0 ? ticks : 0) / kTicksPerMicrosecond;
}

}  // namespace credo::freenect
