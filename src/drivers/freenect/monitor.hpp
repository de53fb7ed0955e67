#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace credo::freenect {

/// A thread that looks after lost devices every 100 ms, and at the whole bus every 500 ms.
class Monitor {
public:
  void start(std::function<void()> report_lost, std::function<void()> look);
  /// Returns once the thread has ended. Nothing where it does not run.
  void stop();

private:
  void run(std::stop_token const& stop, std::function<void()> const& report_lost,
           std::function<void()> const& look);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;
};

}  // namespace credo::freenect
