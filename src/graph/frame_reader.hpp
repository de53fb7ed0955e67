#pragma once

#include <cstdint>
#include <exception>
#include <mutex>

#include "core/frame_source.hpp"
#include "graph/duration_histogram.hpp"
#include "graph/job.hpp"

namespace credo {

/// The first stage: takes frames from a source and holds it to its contract. One thread,
/// but for durations().
class FrameReader {
public:
  /// `source` outlives the reader.
  explicit FrameReader(FrameSource& source) : source_(source) {}

  /// The next frame, good or failed; none at the end of the source, or once it has broken its
  /// contract: see error().
  JobPtr next();

  /// Frames read so far.
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// What the source threw, or std::logic_error where a frame did not follow the one before.
  [[nodiscard]] std::exception_ptr error() const { return error_; }
  /// Time spent in the source for each good frame. Any thread.
  [[nodiscard]] DurationQuantiles durations() const;

private:
  JobPtr read();

  FrameSource& source_;
  std::uint64_t frames_ = 0;
  std::exception_ptr error_;
  mutable std::mutex mutex_;
  DurationHistogram durations_;
};

}  // namespace credo
