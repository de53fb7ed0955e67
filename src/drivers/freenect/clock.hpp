#pragma once

#include <cstdint>
#include <optional>

namespace credo::freenect {

/// A Kinect's clock, 32 bits at 60 MHz, which wraps every 71.58 s, as a time that does not: in
/// microseconds, of one origin for all streams of the device.
///
/// The host's clock tells how many wraps went by. Where the stamp contradicts it (more than 1 s
/// back, more than 10 s off: the device was reset, or the host slept), time goes on from the last
/// stamp by what the host says has gone by. Streams may come a little out of order.
class ClockUnwrapper {
public:
  /// The time of a stamp that arrives at `host_us` of any steady clock.
  std::uint64_t unwrap_us(std::uint32_t stamp, std::int64_t host_us);

private:
  struct Anchor {
    std::uint32_t stamp = 0;
    std::int64_t ticks = 0;
    std::int64_t host_us = 0;
  };
  /// The newest stamp.
  std::optional<Anchor> anchor_;
};

}  // namespace credo::freenect
