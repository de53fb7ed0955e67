#include "graph/ledger.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "graph/process_usage.hpp"

namespace credo {
namespace {

constexpr std::uint64_t kEarlyFrames = 100;

std::string described(FrameFailure const& failure) {
  return "frame " + std::to_string(number(failure.index)) + " (" + failure.reason +
         "): " + failure.message;
}

}  // namespace

Ledger::Ledger(RunSink const& sink, int max_consecutive_failures)
    : sink_(sink),
      max_consecutive_failures_(max_consecutive_failures),
      cpu_s_at_start_(cpu_seconds()) {}

void Ledger::settle(Job& job) {
  std::uint64_t frames = 1;
  for (LostFrames const& lost : job.lost_before) {
    settle_lost(lost);
    frames += static_cast<std::uint64_t>(number(lost.last) - number(lost.first)) + 1;
  }
  if (ended_) {
    ++metrics_.dropped["stopped"];
  } else if (job.failure.has_value()) {
    count_failure(*job.failure);
  } else {
    deliver(job);
  }
  count_through(frames);
}

void Ledger::settle_lost(LostFrames const& lost) {
  for (std::int64_t i = number(lost.first); i <= number(lost.last); ++i) {
    FrameFailure const one{FrameIndex{i}, lost.reason, lost.message};
    if (ended_) {
      ++metrics_.dropped["stopped"];
    } else if (!lost.dropped) {
      count_failure(one);
    } else {
      ++metrics_.dropped[lost.reason];
      try {
        sink_.lost(one);
      } catch (...) {
        end(std::current_exception());
      }
    }
  }
}

void Ledger::deliver(Job const& job) {
  try {
    job.delivery();
  } catch (...) {
    ++metrics_.failed;
    ++metrics_.failures["sink"];
    end(std::current_exception());
    return;
  }
  ++metrics_.frames_out;
  consecutive_failures_ = 0;
  latency_.add(Job::Clock::now() - job.captured);
}

void Ledger::count_failure(FrameFailure const& failure) {
  if (metrics_.failed++ == 0) {
    first_failure_ = failure;
  }
  ++metrics_.failures[failure.reason];
  try {
    sink_.lost(failure);
  } catch (...) {
    end(std::current_exception());
    return;
  }
  // A sensor that is silent may speak again.
  if (failure.loss == Loss::kBad && ++consecutive_failures_ >= max_consecutive_failures_) {
    end(std::make_exception_ptr(InputError(
        std::to_string(consecutive_failures_) + " frames failed in a row, the last " +
        described(failure) + "; mend the source or raise graph.max_consecutive_failures")));
  }
}

void Ledger::count_through(std::uint64_t frames) {
  {
    std::scoped_lock const lock(mutex_);
    if (metrics_.frames_in < kEarlyFrames && metrics_.frames_in + frames >= kEarlyFrames) {
      metrics_.rss_mb_at_100 = resident_mb();
    }
    metrics_.frames_in += frames;
  }
  settled_.notify_all();
}

void Ledger::end(std::exception_ptr error) {
  if (!ended_.exchange(true)) {
    error_ = std::move(error);
  }
}

void Ledger::wait_until_settled(std::uint64_t frames) {
  std::unique_lock lock(mutex_);
  settled_.wait(lock, [&] { return metrics_.frames_in >= frames; });
}

RunMetrics Ledger::so_far() const {
  RunMetrics metrics = metrics_;
  metrics.wall_s = std::chrono::duration<double>(Job::Clock::now() - started_).count();
  metrics.cpu_s = cpu_seconds() - cpu_s_at_start_;
  metrics.fps = static_cast<double>(metrics.frames_out) / metrics.wall_s;
  metrics.rss_mb_end = resident_mb();
  // The kernel counts both by itself, and the peak may lag behind by a few pages.
  metrics.peak_rss_mb = std::max(peak_resident_mb(), metrics.rss_mb_end);
  if (metrics.frames_in < kEarlyFrames) {
    metrics.rss_mb_at_100 = metrics.rss_mb_end;
  }
  metrics.latency = latency_.quantiles();
  return metrics;
}

RunReport Ledger::close(bool wanted_frames) {
  if (error_ == nullptr && metrics_.frames_out == 0 && wanted_frames) {
    error_ = std::make_exception_ptr(InputError(
        metrics_.frames_in == 0 ? "the source has no frames"
        : metrics_.failed == 0  ? "not one of " + std::to_string(metrics_.frames_in) +
                                     " frames came through: all were dropped"
                               : "not one good frame: of " + std::to_string(metrics_.frames_in) +
                                     ", the first to fail was " + described(first_failure_)));
  }
  return {so_far(), error_};
}

}  // namespace credo
