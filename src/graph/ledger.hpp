#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>

#include "core/frame_source.hpp"
#include "graph/duration_histogram.hpp"
#include "graph/job.hpp"
#include "graph/run_report.hpp"
#include "graph/run_sink.hpp"

namespace credo {

/// The end of the line: hands every frame to the sink, counts it, and decides when failures end the
/// run. Once it has ended, what is still under way is counted as dropped ("stopped") and not handed
/// out, so that the results never depend on how far other frames had come.
class Ledger {
public:
  /// `sink` outlives the ledger.
  Ledger(RunSink const& sink, int max_consecutive_failures);

  /// The next frame, and those lost before it. Called by one thread at a time, frames in order.
  void settle(Job& job);

  /// True once an error has ended the run. Any thread.
  [[nodiscard]] bool ended() const { return ended_; }
  /// Waits until so many frames have been settled.
  void wait_until_settled(std::uint64_t frames);
  /// The counts and times so far. Called by the thread that settles.
  [[nodiscard]] RunMetrics so_far() const;
  /// The same with the error; after the last frame. `wanted_frames`: false where the
  /// run was stopped on request, when not one good frame is no error.
  RunReport close(bool wanted_frames);

private:
  void settle_lost(LostFrames const& lost);
  void deliver(Job const& job);
  void count_failure(FrameFailure const& failure);
  void count_through(std::uint64_t frames);
  void end(std::exception_ptr error);

  RunSink const& sink_;
  int max_consecutive_failures_;
  Job::Clock::time_point started_ = Job::Clock::now();
  double cpu_s_at_start_;
  RunMetrics metrics_;
  std::exception_ptr error_;
  DurationHistogram latency_;
  int consecutive_failures_ = 0;
  FrameFailure first_failure_;
  std::atomic<bool> ended_ = false;
  std::mutex mutex_;
  std::condition_variable settled_;
};

}  // namespace credo
