#include "drivers/virtual/sensor_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "drivers/virtual/seeded.hpp"

namespace credo {
namespace {

constexpr std::int64_t kClockStart_ns = 1'000'000'000;
/// A Kinect's clock: 60 counts a microsecond, in 32 bits.
constexpr std::int64_t kCounts_per_us = 60;
constexpr std::int64_t kClockCounts = std::int64_t{1} << 32;

std::int64_t floor_modulo(std::int64_t value, std::int64_t modulus) {
  return (value % modulus + modulus) % modulus;
}

}  // namespace

std::int64_t tick_time_ns(std::int64_t tick, double rate_hz) {
  return std::llround(static_cast<double>(tick) * 1e9 / rate_hz);
}

SensorSchedule::SensorSchedule(SensorScript script, std::size_t images)
    : script_(std::move(script)), images_(images) {
  if (images == 0) {
    throw std::logic_error("SensorSchedule: a dataset without images");
  }
}

double SensorSchedule::rate_hz(SensorStream stream) const {
  return stream == SensorStream::kDepth ? script_.depth_rate_hz : script_.color_rate_hz;
}

std::optional<std::size_t> SensorSchedule::image_at(std::int64_t position) const {
  auto const count = static_cast<std::int64_t>(images_);
  switch (script_.play) {
    case PlayMode::kOnce:
      return position < count ? std::optional(static_cast<std::size_t>(position)) : std::nullopt;
    case PlayMode::kPingPong: {
      // 0 1 2 3 2 1, 0 1 ...: the ends are shown once.
      std::int64_t const step = position % std::max<std::int64_t>(2 * count - 2, 1);
      return static_cast<std::size_t>(step < count ? step : 2 * count - 2 - step);
    }
    case PlayMode::kLoop:
      break;
  }
  return static_cast<std::size_t>(position % count);
}

std::int64_t SensorSchedule::position_of(SensorStream stream, std::int64_t tick) const {
  return std::llround(static_cast<double>(tick) * script_.depth_rate_hz / rate_hz(stream));
}

std::optional<ScheduledImage> SensorSchedule::at(SensorStream stream, std::int64_t tick,
                                                 std::int64_t started_ns) const {
  std::int64_t const time_ns = tick_time_ns(tick, rate_hz(stream));
  std::optional<std::size_t> const position = image_at(position_of(stream, tick));
  if (!position || time_ns < started_ns + script_.start_delay_ns ||
      withheld(stream, tick, time_ns)) {
    return std::nullopt;
  }
  ScheduledImage image{.image = *position, .stamp_us = stamp_us(stream, time_ns)};
  for (Fault const& fault : script_.faults) {
    if (!fault.holds_at(time_ns)) {
      continue;
    }
    if (fault.kind == FaultKind::kCorrupt && fault.concerns(stream)) {
      image.corruption = fault.corruption;
      image.seed = seeded(fault.seed, tick, stream);
    }
    image.registration_ignored |= fault.kind == FaultKind::kIgnoredRegistration;
  }
  return image;
}

bool SensorSchedule::withheld(SensorStream stream, std::int64_t tick, std::int64_t time_ns) const {
  return std::ranges::any_of(script_.faults, [&](Fault const& fault) {
    if (!fault.holds_at(time_ns) || !fault.concerns(stream)) {
      return false;
    }
    switch (fault.kind) {
      case FaultKind::kStall:
        return true;
      case FaultKind::kRate:
        return tick % fault.every != 0;
      case FaultKind::kDrop:
        return fraction_of(seeded(fault.seed, tick, stream)) < fault.share;
      default:
        return false;
    }
  });
}

std::uint64_t SensorSchedule::stamp_us(SensorStream stream, std::int64_t time_ns) const {
  std::int64_t clock_ns = kClockStart_ns + time_ns;
  std::optional<std::int64_t> wrap_ns;
  for (Fault const& fault : script_.faults) {
    bool const jumped = fault.kind == FaultKind::kClockJump && time_ns >= fault.from_ns;
    bool const shifted = fault.kind == FaultKind::kColorShift && stream == SensorStream::kColor &&
                         fault.holds_at(time_ns);
    clock_ns += jumped || shifted ? fault.shift_ns : 0;
    if (fault.kind == FaultKind::kClockWrap) {
      wrap_ns = fault.from_ns + kClockStart_ns;
    }
  }
  if (!wrap_ns) {
    return static_cast<std::uint64_t>(clock_ns / 1000);
  }
  std::int64_t const counts = (clock_ns - *wrap_ns) * kCounts_per_us / 1000;
  return static_cast<std::uint64_t>(floor_modulo(counts, kClockCounts) / kCounts_per_us);
}

PlugState SensorSchedule::plug_state(std::int64_t time_ns) const {
  PlugState state;
  for (Fault const& fault : script_.faults) {
    if (fault.kind == FaultKind::kUnplug) {
      state.plugged = state.plugged && !fault.holds_at(time_ns);
      state.times_unplugged += time_ns >= fault.from_ns ? 1 : 0;
    }
  }
  return state;
}

}  // namespace credo
