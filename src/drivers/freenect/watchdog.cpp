#include "drivers/freenect/watchdog.hpp"

#include <algorithm>

namespace credo::freenect {

void Watchdog::start(Clock::time_point now) {
  patience_ = kFirstPatience;
  silent_since_ = now;
}

void Watchdog::stop() {
  silent_since_.reset();
}

void Watchdog::frame_came(Clock::time_point now) {
  if (runs()) {
    start(now);
  }
}

std::optional<std::chrono::seconds> Watchdog::bark(Clock::time_point now) {
  if (!runs() || now - *silent_since_ < patience_) {
    return std::nullopt;
  }
  std::chrono::seconds const waited = patience_;
  patience_ = std::min(2 * patience_, kMostPatience);
  silent_since_ = now;
  return waited;
}

}  // namespace credo::freenect
