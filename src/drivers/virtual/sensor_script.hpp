#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace credo {

/// A sensor's time counts from the first start of one of its streams, and never stops.
inline constexpr std::int64_t kForever_ns = std::numeric_limits<std::int64_t>::max();

enum class SensorStream : std::uint8_t { kDepth, kColor };

/// What comes after the last image of the dataset.
enum class PlayMode : std::uint8_t {
  /// The first one: forward only, the view jumps.
  kLoop,
  /// The one before it: to and fro, the view never jumps.
  kPingPong,
  /// Nothing more.
  kOnce,
};

enum class FaultKind : std::uint8_t {
  /// No images.
  kStall,
  /// Gone from the list of devices; devices that were open then stay dead.
  kUnplug,
  /// Says that its depth is registered, and delivers what the infrared camera sees.
  kIgnoredRegistration,
  /// Colour stamps are off by shift_ns.
  kColorShift,
  /// The device clock is off by shift_ns from then on.
  kClockJump,
  /// The device clock is a 32-bit count at 60 MHz that starts anew just then.
  kClockWrap,
  /// Images come damaged, as `corruption` says.
  kCorrupt,
  /// Of `every` images only one comes.
  kRate,
  /// The share of images that does not come, at random.
  kDrop,
};

enum class Corruption : std::uint8_t {
  kNone,
  /// An image of half the width and height.
  kSize,
  /// Says that it has half the bytes it should have.
  kShort,
  /// Random pixels.
  kGarbage,
};

struct Fault {
  FaultKind kind = FaultKind::kStall;
  std::int64_t from_ns = 0;
  std::int64_t until_ns = kForever_ns;
  bool depth = true;
  bool color = true;
  std::int64_t shift_ns = 0;
  std::int64_t every = 1;
  double share = 0.0;
  std::uint64_t seed = 0;
  Corruption corruption = Corruption::kNone;

  [[nodiscard]] bool holds_at(std::int64_t time_ns) const {
    return time_ns >= from_ns && time_ns < until_ns;
  }
  [[nodiscard]] bool concerns(SensorStream stream) const {
    return stream == SensorStream::kDepth ? depth : color;
  }
};

/// One sensor, virtual://NAME, and what goes wrong with it.
struct SensorScript {
  std::string name;
  std::filesystem::path dataset;
  double depth_rate_hz = 30.0;
  double color_rate_hz = 30.0;
  PlayMode play = PlayMode::kLoop;
  /// For decoded images; a dataset that fits is decoded once, when the sensor is first opened.
  std::size_t cache_mb = 256;
  /// One line on stderr when it is closed: images handed out, and ticks that came too late.
  bool reports = false;
  bool can_register = true;
  /// Otherwise exposure, gain and white balance are at their defaults again when a stream starts.
  bool keeps_settings = true;
  /// Between the start of a stream and its first image.
  std::int64_t start_delay_ns = 0;
  std::vector<Fault> faults;
};

/// Reads a script, a JSON file (comments allowed) such as
///   {"sensors": [{"name": "kitchen", "dataset": "recordings/kitchen", "play": "ping_pong",
///     "faults": [{"fault": "stall", "stream": "depth", "at_s": 5, "for_s": 3}]}]}
/// Every key, unit and fault: docs/virtual-sensor.md. A dataset's path is relative to the script.
/// Throws InputError, one line that says what is wrong, where and what to do.
std::vector<SensorScript> read_sensor_script(std::filesystem::path const& path);

}  // namespace credo
