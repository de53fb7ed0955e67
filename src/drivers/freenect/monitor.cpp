#include "drivers/freenect/monitor.hpp"

#include <chrono>
#include <utility>

namespace credo::freenect {

void Monitor::start(std::function<void()> report_lost, std::function<void()> look) {
  thread_ = std::jthread([this, report_lost = std::move(report_lost), look = std::move(look)](
                             std::stop_token const& stop) { run(stop, report_lost, look); });
}

void Monitor::stop() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
}

void Monitor::run(std::stop_token const& stop, std::function<void()> const& report_lost,
                  std::function<void()> const& look) {
  constexpr auto kTick = std::chrono::milliseconds(100);
  constexpr int kTicksALook = 5;
  for (int tick = 1; !stop.stop_requested(); ++tick) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, stop, kTick, [] { return false; });
    }
    if (stop.stop_requested()) {
      break;
    }
    report_lost();
    if (tick % kTicksALook == 0) {
      look();
    }
  }
}

}  // namespace credo::freenect
