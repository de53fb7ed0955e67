#pragma once

#include <stop_token>
#include <thread>

namespace credo {

/// Turns the first SIGINT or SIGTERM into a request to stop; a second one ends the process at once.
/// Make it before any other thread: the signals are blocked in the calling thread and in those it
/// starts from then on.
class StopOnSignal {
public:
  StopOnSignal();

  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

private:
  std::stop_source stop_;
  std::jthread waiter_;
};

}  // namespace credo
