#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <utility>

namespace credo {

/// The worker threads of a run. While it lives, parallel work that goes through `execute`, or
/// through a graph made there, runs on `threads()` threads at most; parallel work of a thread
/// outside, such as the one that reads the source, gets no more than these to help it.
class Workers {
public:
  /// 0 = one for each core.
  explicit Workers(int threads)
      : threads_(threads > 0 ? threads : tbb::this_task_arena::max_concurrency()),
        // The limit counts the thread outside as well.
        limit_(tbb::global_control::max_allowed_parallelism,
               static_cast<std::size_t>(threads_) + 1),
        arena_(threads_, 0) {}

  [[nodiscard]] int threads() const { return threads_; }

  /// Runs the function among the workers, waits for it and returns or throws what it does.
  template <typename Function>
  auto execute(Function const& function) {
    return arena_.execute(function);
  }

private:
  int threads_;
  tbb::global_control limit_;
  tbb::task_arena arena_;
};

}  // namespace credo
