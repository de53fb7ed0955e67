#pragma once

#include <chrono>
#include <optional>

namespace credo::freenect {

/// Tells when a stream that should run has been silent for too long: after 2 s, and, as long as
/// nothing comes, after twice as long each time, up to 30 s.
class Watchdog {
public:
  using Clock = std::chrono::steady_clock;

  void start(Clock::time_point now);
  void stop();
  /// Also of a stream that does not run.
  void frame_came(Clock::time_point now);
  [[nodiscard]] bool runs() const { return silent_since_.has_value(); }
  /// How long it has waited, where that was too long; it then waits again.
  std::optional<std::chrono::seconds> bark(Clock::time_point now);

private:
  static constexpr auto kFirstPatience = std::chrono::seconds(2);
  static constexpr auto kMostPatience = std::chrono::seconds(30);

  std::chrono::seconds patience_ = kFirstPatience;
  /// Since the last frame, or the last bark; none where the stream does not run.
  std::optional<Clock::time_point> silent_since_;
};

}  // namespace credo::freenect
