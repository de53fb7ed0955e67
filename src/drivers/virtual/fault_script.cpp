#include "drivers/virtual/fault_script.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

#include "drivers/virtual/sensor_schedule.hpp"

namespace credo {
namespace {

/// A month: sums of such times stay far from the end of 64 bits.
constexpr double kLongest_s = 31.0 * 86400.0;
/// Any image's stamp, shifted so, is still after zero.
constexpr double kMaxColorShift_ms = 1000.0;

std::int64_t seconds_in_ns(double seconds) {
  return std::llround(seconds * 1e9);
}

/// A time on the sensor's clock: `prefix`_s or `prefix`_frame(s); none where neither is given.
std::optional<std::int64_t> time_ns(JsonValue const& fault, std::string const& key_s,
                                    std::string const& key_frames, double rate_hz) {
  if (fault.has(key_s) && fault.has(key_frames)) {
    fault.refuse("has both " + key_s + " and " + key_frames + "; give one of them");
  }
  if (fault.has(key_s)) {
    return seconds_in_ns(number_within(fault.at(key_s), 0, kLongest_s, "s"));
  }
  if (fault.has(key_frames)) {
    std::uint64_t const frame = fault.at(key_frames).count(1'000'000'000);
    return tick_time_ns(static_cast<std::int64_t>(frame), rate_hz);
  }
  return std::nullopt;
}

void read_start(JsonValue const& value, double rate_hz, Fault& fault) {
  fault.from_ns = time_ns(value, "at_s", "at_frame", rate_hz).value_or(0);
}

void read_span(JsonValue const& value, double rate_hz, Fault& fault) {
  read_start(value, rate_hz, fault);
  if (auto const length_ns = time_ns(value, "for_s", "for_frames", rate_hz)) {
    if (*length_ns <= 0) {
      value.refuse("lasts no time; for_s or for_frames must be above 0");
    }
    // Counted in frames, its end is a frame's time to the nanosecond.
    fault.until_ns =
        value.has("at_frame") && value.has("for_frames")
            ? tick_time_ns(static_cast<std::int64_t>(value.at("at_frame").count(~0U) +
                                                     value.at("for_frames").count(~0U)),
                           rate_hz)
            : fault.from_ns + *length_ns;
  }
}

void read_stream(JsonValue const& value, Fault& fault) {
  if (value.has("stream")) {
    enum class Which : std::uint8_t { kDepth, kColor, kBoth };
    auto const which =
        chosen<Which>(value.at("stream"),
                      {{"depth", Which::kDepth}, {"color", Which::kColor}, {"both", Which::kBoth}});
    fault.depth = which != Which::kColor;
    fault.color = which != Which::kDepth;
  }
}

void add_stall(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault", "stream", "at_s", "at_frame", "for_s", "for_frames"});
  Fault fault{.kind = FaultKind::kStall};
  read_span(value, sensor.depth_rate_hz, fault);
  read_stream(value, fault);
  sensor.faults.push_back(fault);
}

void add_unplug(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault", "at_s", "at_frame", "for_s", "for_frames"});
  Fault fault{.kind = FaultKind::kUnplug};
  read_span(value, sensor.depth_rate_hz, fault);
  for (Fault const& other : sensor.faults) {
    if (other.kind == FaultKind::kUnplug && fault.from_ns <= other.until_ns &&
        other.from_ns <= fault.until_ns) {
      value.refuse("begins before another unplug has ended, or ends as it begins");
    }
  }
  sensor.faults.push_back(fault);
}

void add_ignored_registration(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault", "at_s", "at_frame", "for_s", "for_frames"});
  Fault fault{.kind = FaultKind::kIgnoredRegistration};
  read_span(value, sensor.depth_rate_hz, fault);
  sensor.faults.push_back(fault);
}

void add_missing_registration(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault"});
  sensor.can_register = false;
}

void add_color_shift(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault", "by_ms", "at_s", "at_frame", "for_s", "for_frames"});
  Fault fault{.kind = FaultKind::kColorShift};
  read_span(value, sensor.depth_rate_hz, fault);
  fault.shift_ns = std::llround(
      number_within(value.at("by_ms"), -kMaxColorShift_ms, kMaxColorShift_ms, "ms") * 1e6);
  sensor.faults.push_back(fault);
}

/// Stamps have no sign.
void refuse_negative_clock(JsonValue const& value, SensorScript const& sensor) {
  for (Fault const& jump : sensor.faults) {
    std::int64_t clock_ns = jump.from_ns;
    for (Fault const& other : sensor.faults) {
      bool const before = other.kind == FaultKind::kClockJump && other.from_ns <= jump.from_ns;
      clock_ns += before ? other.shift_ns : 0;
    }
    if (jump.kind == FaultKind::kClockJump && clock_ns < 0) {
      value.at("by_s").refuse("takes the clock back beyond its start; jump less, or later");
    }
  }
}

void add_clock_jump(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault", "by_s", "at_s", "at_frame"});
  Fault fault{.kind = FaultKind::kClockJump};
  read_start(value, sensor.depth_rate_hz, fault);
  fault.shift_ns = seconds_in_ns(number_within(value.at("by_s"), -kLongest_s, kLongest_s, "s"));
  sensor.faults.push_back(fault);
  refuse_negative_clock(value, sensor);
}

void add_clock_wrap(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault", "at_s", "at_frame"});
  Fault fault{.kind = FaultKind::kClockWrap};
  read_start(value, sensor.depth_rate_hz, fault);
  if (std::ranges::find(sensor.faults, FaultKind::kClockWrap, &Fault::kind) !=
      sensor.faults.end()) {
    value.refuse("the clock wraps again every 71.58 s by itself; say the first time only");
  }
  sensor.faults.push_back(fault);
}

void add_corrupt(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object(
      {"fault", "how", "seed", "stream", "at_s", "at_frame", "for_s", "for_frames"});
  Fault fault{.kind = FaultKind::kCorrupt};
  read_span(value, sensor.depth_rate_hz, fault);
  read_stream(value, fault);
  fault.corruption = chosen<Corruption>(value.at("how"), {{"size", Corruption::kSize},
                                                          {"short", Corruption::kShort},
                                                          {"garbage", Corruption::kGarbage}});
  fault.seed = value.has("seed") ? value.at("seed").count(~0ULL) : 0;
  sensor.faults.push_back(fault);
}

void add_rate(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault", "every", "stream", "at_s", "at_frame", "for_s", "for_frames"});
  Fault fault{.kind = FaultKind::kRate};
  read_span(value, sensor.depth_rate_hz, fault);
  read_stream(value, fault);
  fault.every = static_cast<std::int64_t>(value.at("every").count(1'000'000));
  if (fault.every < 2) {
    value.at("every").refuse("must be 2 or above: of so many images one comes");
  }
  sensor.faults.push_back(fault);
}

void add_drop(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object(
      {"fault", "share", "seed", "stream", "at_s", "at_frame", "for_s", "for_frames"});
  Fault fault{.kind = FaultKind::kDrop};
  read_span(value, sensor.depth_rate_hz, fault);
  read_stream(value, fault);
  fault.share = value.at("share").fraction();
  fault.seed = value.has("seed") ? value.at("seed").count(~0ULL) : 0;
  sensor.faults.push_back(fault);
}

void set_slow_start(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault", "delay_s"});
  sensor.start_delay_ns = seconds_in_ns(number_within(value.at("delay_s"), 0, kLongest_s, "s"));
}

void set_forget_settings(JsonValue const& value, SensorScript& sensor) {
  value.must_be_object({"fault"});
  sensor.keeps_settings = false;
}

}  // namespace

double number_within(JsonValue const& value, double low, double high, char const* unit) {
  double const number = value.number();
  if (!(number >= low && number <= high)) {
    std::ostringstream text;
    text << "must be in [" << low << ", " << high << "] " << unit;
    value.refuse(text.str());
  }
  return number;
}

void add_fault(JsonValue const& value, SensorScript& sensor) {
  using Add = void (*)(JsonValue const&, SensorScript&);
  static std::map<std::string, Add> const adders = {
      {"stall", add_stall},
      {"unplug", add_unplug},
      {"registration_ignored", add_ignored_registration},
      {"registration_missing", add_missing_registration},
      {"color_shift", add_color_shift},
      {"clock_jump", add_clock_jump},
      {"clock_wrap", add_clock_wrap},
      {"corrupt", add_corrupt},
      {"rate", add_rate},
      {"drop", add_drop},
      {"slow_start", set_slow_start},
      {"forget_settings", set_forget_settings},
  };
  if (!value.json.is_object()) {
    value.refuse("must be an object with the key fault");
  }
  chosen<Add>(value.at("fault"), adders)(value, sensor);
}

}  // namespace credo
