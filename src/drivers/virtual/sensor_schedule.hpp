#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "drivers/virtual/sensor_script.hpp"

namespace credo {

/// When tick n of a stream is due, counted from the sensor's first start.
std::int64_t tick_time_ns(std::int64_t tick, double rate_hz);

/// What a stream hands out at one tick.
struct ScheduledImage {
  /// Which image of the dataset.
  std::size_t image = 0;
  /// On the device clock, which is at 1 s when the sensor starts.
  std::uint64_t stamp_us = 0;
  /// Depth is as the infrared camera sees it, whatever the registration mode says.
  bool registration_ignored = false;
  Corruption corruption = Corruption::kNone;
  /// Of garbage pixels.
  std::uint64_t seed = 0;
  friend bool operator==(ScheduledImage const&, ScheduledImage const&) = default;
};

/// Whether a sensor is there, and how often it was unplugged before.
struct PlugState {
  bool plugged = true;
  int times_unplugged = 0;
  friend bool operator==(PlugState const&, PlugState const&) = default;
};

/// A sensor's script as answers to "what happens when": no clock, no state, always the same.
class SensorSchedule {
public:
  /// `images` are in the dataset. Throws std::logic_error where there are none.
  SensorSchedule(SensorScript script, std::size_t images);

  [[nodiscard]] double rate_hz(SensorStream stream) const;
  /// Of so many images, counted from the sensor's start as if none were ever missing, the position
  /// in the dataset; none where it has come to its end.
  [[nodiscard]] std::optional<std::size_t> image_at(std::int64_t position) const;
  /// The position, as above, of a stream's tick: streams of different rates show the same time.
  [[nodiscard]] std::int64_t position_of(SensorStream stream, std::int64_t tick) const;
  /// What a stream hands out at a tick from 0, nothing included, that was started at `started_ns`.
  /// It does not know whether the sensor is plugged in.
  [[nodiscard]] std::optional<ScheduledImage> at(SensorStream stream, std::int64_t tick,
                                                 std::int64_t started_ns = 0) const;

  [[nodiscard]] PlugState plug_state(std::int64_t time_ns) const;

private:
  [[nodiscard]] std::uint64_t stamp_us(SensorStream stream, std::int64_t time_ns) const;
  [[nodiscard]] bool withheld(SensorStream stream, std::int64_t tick, std::int64_t time_ns) const;

  SensorScript script_;
  std::size_t images_;
};

}  // namespace credo
