#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <vector>

#include "support/fake_usb/fake_usb.hpp"

namespace credo::test::fake_usb {

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;

/// 11 bits a value, the highest first, without gaps.
Bytes packed_11(std::vector<std::uint16_t> const& values);

/// The frames of a device by its clock.
struct Pace {
  Clock::time_point frame_0;
  double rate_hz = 30;
  std::uint32_t first_stamp = 0;

  [[nodiscard]] Clock::time_point frame_start(double frame) const;
  /// The first frame that starts at or after that time.
  [[nodiscard]] std::int64_t next_frame(Clock::time_point time) const;
  [[nodiscard]] std::uint32_t stamp(std::int64_t frame) const;
};

/// The packets of one stream: each frame cut into packets of equal size, each with a header.
class PacketStream {
public:
  /// `id`: 0x70 for depth, 0x80 for colour. `lead`: packets come so many frames early. `frames`:
  /// what it shows, over and over.
  PacketStream(std::uint8_t id, std::size_t payload_bytes, std::uint32_t delay_ticks, double lead,
               std::vector<Bytes> frames);

  void start(Pace const& pace, Clock::time_point now);
  void stop() { running_ = false; }
  void stall() { stalled_ = true; }
  void lose(int packets) { to_lose_ = packets; }

  [[nodiscard]] bool running() const { return running_ && !frames_.empty(); }
  /// When so many more packets will have come; never, where it is stopped or stalled.
  [[nodiscard]] Clock::time_point due(Pace const& pace, int packets) const;
  /// The next packet.
  Bytes next(Pace const& pace);

private:
  [[nodiscard]] std::size_t packets_per_frame() const;

  std::uint8_t id_;
  std::size_t payload_bytes_;
  std::uint32_t delay_ticks_;
  double lead_;
  std::vector<Bytes> frames_;
  bool running_ = false;
  bool stalled_ = false;
  int to_lose_ = 0;
  std::int64_t frame_ = 0;
  std::size_t packet_ = 0;
  std::uint8_t sequence_ = 0;
};

}  // namespace credo::test::fake_usb
