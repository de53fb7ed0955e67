#include <cmath>
#include <string>

#include "doctor/sensor_findings.hpp"
#include "doctor/text.hpp"

namespace credo {
namespace {

/// Starting takes a Kinect less than that.
constexpr double kSlowStart_s = 3.0;
/// Of the mode's rate.
constexpr double kFullRate = 0.95;
constexpr double kHardlyAny = 0.2;
constexpr double kFewLost = 0.01;
/// What comes from one trigger has stamps nearer than that.
constexpr double kInSync_ms = 5.0;
constexpr double kMostlyPaired = 0.9;
/// Quartzes differ by up to 100 ppm.
constexpr double kBadClock_ppm = 1000.0;
/// An image may always be as late as that.
constexpr double kArrival_ms = 5.0;

constexpr char const* kMakeRoom =
    "end what keeps this computer busy (top); then another USB socket, without a hub, and nothing "
    "else on that controller (lsusb -t)";

bool is_slow(StreamTiming const& timing, int mode_hz) {
  return timing.rate_by_arrival_hz < kFullRate * mode_hz;
}

void judge_rate(std::string const& name, StreamTiming const& timing, int mode_hz,
                Section& section) {
  std::string const found = fixed_text(timing.rate_by_arrival_hz, 1) + " images/s by arrival, " +
                            fixed_text(timing.rate_by_stamp_hz, 1) + " by its stamps, " +
                            std::to_string(mode_hz) + " by its mode; longest gap " +
                            fixed_text(1000.0 * timing.longest_gap_s, 0) + " ms";
  if (timing.rate_by_arrival_hz < kHardlyAny * mode_hz) {
    section.error(name + " rate", found, kMakeRoom);
  } else if (is_slow(timing, mode_hz)) {
    section.warning(name + " rate", found, kMakeRoom);
  } else {
    section.ok(name + " rate", found);
  }
}

void judge_losses(std::string const& name, StreamTiming const& timing, int mode_hz,
                  Section& section) {
  int const sent = timing.images + timing.lost;
  std::string const found =
      std::to_string(timing.lost) + " of " + std::to_string(sent) + " by their numbers";
  if (timing.lost > kFewLost * sent && timing.lost > 1) {
    section.warning(name + " lost", found,
                    is_slow(timing, mode_hz) ? "see " + name + " rate" : kMakeRoom);
  } else {
    section.ok(name + " lost", found);
  }
}

void judge_first(SensorMeasurement const& measured, Section& section) {
  std::string const found = fixed_text(measured.waited_s, 1) + " s after it was opened";
  if (measured.waited_s > kSlowStart_s) {
    section.warning("first depth image", found,
                    "credo run waits for it for sensor.first_frame_s; if it comes ever later: "
                    "unplug the sensor and plug it in again");
  } else {
    section.ok("first depth image", found);
  }
}

void judge_color(SensorMeasurement const& measured, Section& section) {
  if (!measured.has_color) {
    section.warning("colour", "none of the size of its depth",
                    "credo runs without: it then tells things apart by depth alone");
  } else if (measured.color.empty()) {
    section.warning("colour", "not one image in " + fixed_text(measured.measured_s, 1) + " s",
                    "unplug the sensor and plug it in again; credo run starts its colour anew now "
                    "and then, and goes on without");
  } else {
    StreamTiming const timing = timing_of(measured.color);
    judge_rate("colour", timing, measured.color_rate_hz, section);
    judge_losses("colour", timing, measured.color_rate_hz, section);
  }
}

void judge_sync(SensorMeasurement const& measured, Section& section) {
  auto const sync = sync_of(measured.depth, measured.color, measured.depth_rate_hz);
  if (!sync) {
    return;
  }
  std::string const found = "colour is " + fixed_text(std::abs(sync->median_ms), 1) + " ms " +
                            (sync->median_ms < 0.0 ? "before" : "after") +
                            " depth (median), at worst " + fixed_text(sync->worst_ms, 1) + " ms; " +
                            percent_text(sync->paired_share) +
                            " of the depth images have colour within half a frame's time";
  if (sync->paired_share < kMostlyPaired) {
    section.warning("sync", found,
                    "frames without colour are told apart by depth alone; plug the sensor in "
                    "again, and see colour rate");
  } else if (std::abs(sync->median_ms) > kInSync_ms) {
    section.warning("sync", found,
                    "what moves at 1 m/s has its colour " +
                        fixed_text(std::abs(sync->median_ms), 0) +
                        " mm beside it; plug the sensor in again: its streams start anew");
  } else {
    section.ok("sync", found);
  }
}

void judge_clock(SensorMeasurement const& measured, Section& section) {
  if (measured.clock_jumps > 0) {
    section.warning("clock", "jumped " + std::to_string(measured.clock_jumps) + " times",
                    "credo run then goes on by this computer's clock, less exactly; plug the "
                    "sensor in again");
    return;
  }
  auto const drift = drift_of(measured.depth);
  if (!drift) {
    return;
  }
  std::string const found = fixed_text(std::abs(drift->ppm), 0) + " ppm " +
                            (drift->ppm < 0.0 ? "slower" : "faster") +
                            " than this computer's, no jumps";
  if (std::abs(drift->ppm) > kBadClock_ppm && std::abs(drift->change_ms) > kArrival_ms) {
    section.warning("clock", found,
                    "measure again for longer: credo doctor --seconds 20; if it stays, speeds and "
                    "times are wrong by as much");
  } else {
    section.ok("clock", found);
  }
}

}  // namespace

std::vector<Finding> stream_findings(SensorMeasurement const& measured) {
  Section section("streams");
  for (std::string const& warning : measured.warnings) {
    // What of colour is not there is told below.
    if (measured.has_color) {
      section.warning("settings", warning, "take it out of the config, or name what it can");
    }
  }
  if (measured.depth.empty()) {
    section.error("first depth image",
                  measured.unplugged ? "the sensor went before one came"
                                     : "none in " + fixed_text(measured.waited_s, 1) + " s",
                  "unplug the sensor, from its power supply, too, wait five seconds, and plug it "
                  "in again; then another USB socket, another cable");
    return section.take();
  }
  judge_first(measured, section);
  StreamTiming const timing = timing_of(measured.depth);
  judge_rate("depth", timing, measured.depth_rate_hz, section);
  judge_losses("depth", timing, measured.depth_rate_hz, section);
  if (measured.broken > 0) {
    section.error("depth images",
                  std::to_string(measured.broken) + " were not whole, as " + measured.broken_why,
                  "is its cable sound? Try another USB socket");
  }
  if (measured.unplugged) {
    section.error("connection", "the sensor went while it was measured",
                  "is its plug loose, or its power supply? Look at: sudo dmesg | tail");
  }
  judge_color(measured, section);
  judge_sync(measured, section);
  judge_clock(measured, section);
  return section.take();
}

}  // namespace credo
