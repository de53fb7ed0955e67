#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace credo {

/// When an image was taken and when it came.
struct ImageTime {
  /// Of the sensor's clock, made continuous.
  std::int64_t stamp_ns = 0;
  std::chrono::steady_clock::time_point arrival;
  /// Counts up, images that did not come included.
  int number = 0;
};

/// How a stream's images came.
struct StreamTiming {
  int images = 0;
  /// By their numbers, images that are missing between the first and the last.
  int lost = 0;
  /// 0 for less than two images.
  double rate_by_stamp_hz = 0.0;
  double rate_by_arrival_hz = 0.0;
  double longest_gap_s = 0.0;
};
StreamTiming timing_of(std::vector<ImageTime> const& images);

/// How two streams fit in time.
struct StreamSync {
  /// Nearest colour stamp - depth stamp: the median, and the one farthest off.
  double median_ms = 0.0;
  double worst_ms = 0.0;
  /// Depth images with a colour image within half a frame's time.
  double paired_share = 0.0;
};
/// Of the time in which both came; none where that holds no depth image.
std::optional<StreamSync> sync_of(std::vector<ImageTime> const& depth,
                                  std::vector<ImageTime> const& color, double rate_hz);

/// The sensor's clock against this computer's.
struct ClockDrift {
  /// Above 0: the sensor's runs faster.
  double ppm = 0.0;
  /// What it gained or lost over the measurement.
  double change_ms = 0.0;
};
/// Images come late now and then, never early: so the least delay of the first third is compared
/// with that of the last. None for less than 1 s or 9 images.
std::optional<ClockDrift> drift_of(std::vector<ImageTime> const& images);

}  // namespace credo
