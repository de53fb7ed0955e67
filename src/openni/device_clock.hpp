#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace credo {

/// Makes one time of a sensor's clock that runs on for ever, whatever that clock does: a Kinect's
/// wraps every 71.6 s (2^32 ticks of 60 MHz), others jump when they are set, or begin anew when the
/// sensor is plugged in again.
///
/// One stream leads; its time only grows, by no more than the host's clock says has gone by and
/// half a second, as images queue. A stamp that does not fit is a jump: time then goes on by the
/// host's clock, so that a jump's size is known only as well as images come in time. A wrap is
/// known exactly. Other streams follow: their images take the reckoning, from before a jump or
/// after, that brings them nearer to when they came.
class DeviceClock {
public:
  using HostTime = std::chrono::steady_clock::time_point;

  /// The time of an image of the leading stream [ns], from the sensor's stamp [us] and when it
  /// came. The first stamp stands as it is.
  std::int64_t time_ns(std::uint64_t stamp_us, HostTime arrival);
  /// The same for another stream; before the first leading image, the stamp.
  [[nodiscard]] std::int64_t following_time_ns(std::uint64_t stamp_us, HostTime arrival) const;

  /// The sensor's clock begins anew.
  void restart() { restarts_ = true; }

  /// How often the clock was found to have jumped; wraps and restarts are none.
  [[nodiscard]] std::uint64_t jumps() const { return jumps_; }

private:
  struct Last {
    std::int64_t time_ns = 0;
    HostTime arrival;
  };

  /// What the host's clock expects of an image that comes now.
  [[nodiscard]] std::int64_t expected_ns(HostTime arrival) const;
  [[nodiscard]] bool fits(std::int64_t time_ns, HostTime arrival) const;

  std::optional<Last> last_;
  /// Time = stamp + offset: now, and before the last jump or wrap.
  std::int64_t offset_ns_ = 0;
  std::int64_t offset_before_ns_ = 0;
  bool restarts_ = false;
  std::uint64_t jumps_ = 0;
};

}  // namespace credo
