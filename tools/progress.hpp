#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "core/frame_source.hpp"
#include "core/run_metrics.hpp"
#include "detection_log.hpp"
#include "graph/run_sink.hpp"
#include "status_line.hpp"

namespace credo {

/// How a run shows itself to the person who started it, on stderr: one line that is redrawn where
/// that is a terminal, a line every few seconds where it is not; lost frames and refused detections
/// in the log. Called by one thread at a time.
class Progress {
public:
  /// `frame_count` of a source that knows its end.
  explicit Progress(std::optional<std::int64_t> frame_count);

  void show(FrameResult const& result);
  /// Logs the first few of each reason; the rest are only counted.
  void lost(FrameFailure const& failure) { losses_.add(failure, line_); }
  /// Ends the redrawn line.
  void finish() { line_.finish(); }
  /// What became of detections; empty where nobody looked for objects.
  [[nodiscard]] std::string detection_summary() const { return detections_.summary(); }

private:
  using Clock = std::chrono::steady_clock;

  StatusLine line_;
  std::optional<std::int64_t> frame_count_;
  Clock::time_point last_shown_;
  std::int64_t frames_since_ = 0;
  LossLog losses_;
  DetectionLog detections_;
};

/// The table at the end of a run.
std::string summary_table(RunMetrics const& metrics);

}  // namespace credo
