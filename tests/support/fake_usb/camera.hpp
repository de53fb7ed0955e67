#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "support/fake_usb/fake_usb.hpp"
#include "support/fake_usb/packets.hpp"

namespace credo::test::fake_usb {

/// A Kinect's camera: answers commands and sends its two streams. Not for several threads at once.
class Camera {
public:
  explicit Camera(Kinect kinect);

  /// Takes a command as it was sent.
  void command(Bytes const& bytes, Clock::time_point now);
  /// The answer to the last one; empty where there was none.
  [[nodiscard]] Bytes const& reply() const { return reply_; }

  [[nodiscard]] std::string const& serial() const { return serial_; }
  [[nodiscard]] Pace const& pace() const { return pace_; }
  PacketStream& depth() { return depth_; }
  PacketStream& color() { return color_; }
  [[nodiscard]] int depth_starts() const { return depth_starts_; }
  [[nodiscard]] int color_starts() const { return color_starts_; }
  [[nodiscard]] std::uint16_t color_flags();

private:
  Bytes answer(std::uint16_t code, Bytes const& arguments, Clock::time_point now);
  void write_register(std::uint16_t address, std::uint16_t value, Clock::time_point now);
  Bytes color_register(Bytes const& arguments);

  std::string serial_;
  Pace pace_;
  PacketStream depth_;
  PacketStream color_;
  std::map<std::uint16_t, std::uint16_t> registers_;
  std::map<std::uint16_t, std::uint16_t> color_registers_;
  Bytes reply_;
  int depth_starts_ = 0;
  int color_starts_ = 0;
};

}  // namespace credo::test::fake_usb
