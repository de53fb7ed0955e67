#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "core/frame_source.hpp"

namespace credo {

/// How a command that goes on for long shows itself, on stderr: one line that is redrawn where that
/// is a terminal, a line every few seconds where it is not.
class StatusLine {
public:
  StatusLine();

  /// Whether it is time for a new line.
  [[nodiscard]] bool is_due() const;
  void show(std::string const& line);
  /// Ends the redrawn line.
  void finish();

private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  Clock::time_point last_shown_;
  bool line_open_ = false;
};

/// Tells of lost frames in the log: the first few of each reason; the rest are only counted.
class LossLog {
public:
  /// `line` is ended before anything is told.
  void add(FrameFailure const& failure, StatusLine& line);
  [[nodiscard]] std::map<std::string, std::uint64_t> const& by_reason() const { return by_reason_; }

private:
  std::map<std::string, std::uint64_t> by_reason_;
};

/// " (2 missed, 1 stalled)"; empty where there are none.
std::string counts_text(std::map<std::string, std::uint64_t> const& counts);

/// The log goes to stderr, a line each.
void log_to_stderr();

}  // namespace credo
