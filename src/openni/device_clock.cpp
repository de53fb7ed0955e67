#include "openni/device_clock.hpp"

#include <algorithm>
#include <cstdlib>

namespace credo {
namespace {

/// How much later than the host's clock says an image may have been taken.
constexpr std::int64_t kMostAhead_ns = 500'000'000;
/// 2^32 ticks of 60 MHz.
constexpr std::int64_t kWrap_ns = 71'582'788'267;

std::int64_t nanoseconds(std::uint64_t stamp_us) {
  return static_cast<std::int64_t>(stamp_us) * 1000;
}

}  // namespace

std::int64_t DeviceClock::expected_ns(HostTime arrival) const {
  auto const passed = std::max(arrival - last_->arrival, HostTime::duration::zero());
  return last_->time_ns + std::chrono::duration_cast<std::chrono::nanoseconds>(passed).count();
}

bool DeviceClock::fits(std::int64_t time_ns, HostTime arrival) const {
  return time_ns > last_->time_ns && time_ns <= expected_ns(arrival) + kMostAhead_ns;
}

std::int64_t DeviceClock::time_ns(std::uint64_t stamp_us, HostTime arrival) {
  std::int64_t const stamp_ns = nanoseconds(stamp_us);
  if (last_ && (restarts_ || !fits(stamp_ns + offset_ns_, arrival))) {
    offset_before_ns_ = offset_ns_;
    if (!restarts_ && fits(stamp_ns + offset_ns_ + kWrap_ns, arrival)) {
      offset_ns_ += kWrap_ns;
    } else {
      jumps_ += restarts_ ? 0 : 1;
      // Time must grow even where the host's clock has not moved.
      offset_ns_ = std::max(expected_ns(arrival), last_->time_ns + 1) - stamp_ns;
    }
  }
  restarts_ = false;
  last_ = {stamp_ns + offset_ns_, arrival};
  return last_->time_ns;
}

std::int64_t DeviceClock::following_time_ns(std::uint64_t stamp_us, HostTime arrival) const {
  std::int64_t const stamp_ns = nanoseconds(stamp_us);
  if (!last_) {
    return stamp_ns;
  }
  std::int64_t const now_ns = stamp_ns + offset_ns_;
  std::int64_t const before_ns = stamp_ns + offset_before_ns_;
  std::int64_t const expected = expected_ns(arrival);
  return std::abs(before_ns - expected) < std::abs(now_ns - expected) ? before_ns : now_ns;
}

}  // namespace credo
