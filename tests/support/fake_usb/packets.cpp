#include "support/fake_usb/packets.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace credo::test::fake_usb {
namespace {

constexpr double kClock_hz = 60e6;
constexpr std::size_t kHeaderBytes = 12;
/// Where packets are lost.
constexpr std::size_t kMiddlePacket = 80;

enum Mark : std::uint8_t { kFirst = 1, kWithin = 2, kLast = 5 };

}  // namespace

Bytes packed_11(std::vector<std::uint16_t> const& values) {
  Bytes packed;
  packed.reserve(values.size() * 11 / 8 + 1);
  std::uint32_t waiting = 0;
  int bits = 0;
  for (std::uint16_t const value : values) {
    waiting = waiting << 11 | (value & 0x7FFU);
    for (bits += 11; bits >= 8; bits -= 8) {
      packed.push_back(static_cast<std::uint8_t>(waiting >> (bits - 8)));
    }
  }
  return packed;
}

Clock::time_point Pace::frame_start(double frame) const {
  return frame_0 + std::chrono::duration_cast<Clock::duration>(
                       std::chrono::duration<double>(frame / rate_hz));
}

std::int64_t Pace::next_frame(Clock::time_point time) const {
  std::chrono::duration<double> const since = time - frame_0;
  return static_cast<std::int64_t>(std::ceil(since.count() * rate_hz));
}

std::uint32_t Pace::stamp(std::int64_t frame) const {
  double const ticks = static_cast<double>(frame) * kClock_hz / rate_hz;
  return first_stamp + static_cast<std::uint32_t>(std::llround(ticks));
}

PacketStream::PacketStream(std::uint8_t id, std::size_t payload_bytes, std::uint32_t delay_ticks,
                           double lead, std::vector<Bytes> frames)
    : id_(id),
      payload_bytes_(payload_bytes),
      delay_ticks_(delay_ticks),
      lead_(lead),
      frames_(std::move(frames)) {}

void PacketStream::start(Pace const& pace, Clock::time_point now) {
  running_ = true;
  stalled_ = false;
  frame_ = pace.next_frame(now);
  packet_ = 0;
}

std::size_t PacketStream::packets_per_frame() const {
  return (frames_.front().size() + payload_bytes_ - 1) / payload_bytes_;
}

Clock::time_point PacketStream::due(Pace const& pace, int packets) const {
  // A stream stalls between frames.
  if (!running() || (stalled_ && packet_ == 0)) {
    return Clock::time_point::max();
  }
  // In bursts: whoever waits is woken less often.
  constexpr std::size_t kBurst = 64;
  std::size_t const needed = packet_ + static_cast<std::size_t>(packets);
  std::size_t const sent = (needed + kBurst - 1) / kBurst * kBurst;
  double const share = static_cast<double>(sent) / static_cast<double>(packets_per_frame());
  return pace.frame_start(static_cast<double>(frame_) + share - lead_);
}

Bytes PacketStream::next(Pace const& pace) {
  std::size_t const count = packets_per_frame();
  if (to_lose_ > 0 && packet_ == kMiddlePacket) {
    packet_ += static_cast<std::size_t>(to_lose_);
    sequence_ = static_cast<std::uint8_t>(sequence_ + std::exchange(to_lose_, 0));
  }
  Bytes const& frame = frames_[static_cast<std::size_t>(frame_) % frames_.size()];
  std::size_t const from = packet_ * payload_bytes_;
  std::size_t const bytes = std::min(payload_bytes_, frame.size() - from);
  std::uint8_t const mark = packet_ == 0 ? kFirst : packet_ + 1 == count ? kLast : kWithin;
  std::uint32_t const stamp = pace.stamp(frame_) + delay_ticks_;
  Bytes packet = {'R', 'B', 0, static_cast<std::uint8_t>(id_ | mark), 0, sequence_++, 0, 0};
  packet.resize(kHeaderBytes + bytes);
  std::memcpy(packet.data() + 8, &stamp, sizeof(stamp));
  std::memcpy(packet.data() + kHeaderBytes, frame.data() + from, bytes);
  if (++packet_ == count) {
    packet_ = 0;
    ++frame_;
  }
  return packet;
}

}  // namespace credo::test::fake_usb
