#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace credo {

/// Quantiles of a time, milliseconds.
struct DurationQuantiles {
  std::uint64_t count = 0;
  double p50_ms = 0.0;
  double p95_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

struct QueueMetrics {
  std::uint64_t capacity = 0;
  std::uint64_t peak = 0;
  std::uint64_t dropped = 0;
};

/// How a run has gone so far, or went. frames_in = frames_out + failed + the sum of `dropped`.
struct RunMetrics {
  std::uint64_t frames_in = 0;
  std::uint64_t frames_out = 0;
  std::uint64_t failed = 0;
  /// `failed` by reason.
  std::map<std::string, std::uint64_t> failures;
  std::map<std::string, std::uint64_t> dropped;
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double fps = 0.0;
  double peak_rss_mb = 0.0;
  double rss_mb_at_100 = 0.0;
  double rss_mb_end = 0.0;
  DurationQuantiles latency;
  /// In the order that a frame passes them.
  std::vector<std::pair<std::string, DurationQuantiles>> stages;
  std::vector<std::pair<std::string, QueueMetrics>> queues;
};

}  // namespace credo
