#include "support/fake_usb/camera.hpp"

#include <cstring>
#include <utility>

#include "support/fake_usb/calibration.hpp"

namespace credo::test::fake_usb {
namespace {

// As libfreenect cuts a frame: the rest of a packet is its header.
constexpr std::size_t kDepthPayload = 1748;
constexpr std::size_t kColorPayload = 1908;

constexpr std::uint16_t kColorSwitch = 0x05;
constexpr std::uint16_t kDepthSwitch = 0x06;
constexpr std::uint16_t kColorFlags = 0x106;
/// Automatic exposure and white balance are on whenever colour starts.
constexpr std::uint16_t kColorFlagsAtFirst = 1U << 14 | 1U << 1;

enum Command : std::uint16_t {
  kReadRegister = 0x02,
  kWriteRegister = 0x03,
  kFixedParameters = 0x04,
  kAlgorithmParameters = 0x16,
  kColorRegister = 0x95,
};

std::uint16_t word(Bytes const& bytes, std::size_t index) {
  std::uint16_t value = 0;
  if (bytes.size() >= 2 * index + 2) {
    std::memcpy(&value, bytes.data() + 2 * index, 2);
  }
  return value;
}

Bytes bytes_of(std::vector<std::uint16_t> const& words) {
  Bytes bytes(2 * words.size());
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

std::vector<Bytes> packed_all(std::vector<std::vector<std::uint16_t>> const& images) {
  std::vector<Bytes> packed;
  for (auto const& image : images) {
    packed.push_back(packed_11(image));
  }
  return packed;
}

}  // namespace

Camera::Camera(Kinect kinect)
    : serial_(std::move(kinect.serial)),
      pace_{Clock::now(), kinect.rate_hz, kinect.first_stamp},
      depth_(0x70, kDepthPayload, 0, 0, packed_all(kinect.images.depth_raw)),
      color_(0x80, kColorPayload, kColorDelay_ticks, kinect.color_lead,
             std::move(kinect.images.color_bayer)) {
  color_registers_[kColorFlags] = kColorFlagsAtFirst;
}

std::uint16_t Camera::color_flags() {
  return color_registers_[kColorFlags];
}

void Camera::command(Bytes const& bytes, Clock::time_point now) {
  // "GM", length in words, code, number; the answer repeats the last two behind "RB".
  constexpr std::size_t kHeaderBytes = 8;
  if (bytes.size() < kHeaderBytes || bytes[0] != 'G' || bytes[1] != 'M') {
    reply_.clear();
    return;
  }
  Bytes const arguments(bytes.begin() + kHeaderBytes, bytes.end());
  Bytes const answered = answer(word(bytes, 2), arguments, now);
  reply_ = bytes_of({std::uint16_t{'R' | 'B' << 8}, static_cast<std::uint16_t>(answered.size() / 2),
                     word(bytes, 2), word(bytes, 3)});
  reply_.insert(reply_.end(), answered.begin(), answered.end());
}

Bytes Camera::answer(std::uint16_t code, Bytes const& arguments, Clock::time_point now) {
  switch (code) {
    case kReadRegister:
      return bytes_of({0, registers_[word(arguments, 0)]});
    case kWriteRegister:
      write_register(word(arguments, 0), word(arguments, 1), now);
      return bytes_of({0});
    case kFixedParameters:
      return fixed_parameters();
    case kColorRegister:
      return color_register(arguments);
    case kAlgorithmParameters:
      return word(arguments, 0) == 0x40   ? registration_parameters()
             : word(arguments, 0) == 0x41 ? padding_parameters()
                                          : shift_parameters();
    default:
      return {};
  }
}

void Camera::write_register(std::uint16_t address, std::uint16_t value, Clock::time_point now) {
  registers_[address] = value;
  if (address != kDepthSwitch && address != kColorSwitch) {
    return;
  }
  PacketStream& stream = address == kDepthSwitch ? depth_ : color_;
  if (value == 0) {
    stream.stop();
  } else {
    ++(address == kDepthSwitch ? depth_starts_ : color_starts_);
    if (address == kColorSwitch) {
      color_registers_[kColorFlags] = kColorFlagsAtFirst;
    }
    stream.start(pace_, now);
  }
}

Bytes Camera::color_register(Bytes const& arguments) {
  constexpr std::uint16_t kWrites = 0x8000;
  std::uint16_t const address = word(arguments, 1);
  std::uint16_t& value = color_registers_[address & ~kWrites & 0xFFFF];
  if ((address & kWrites) != 0) {
    value = word(arguments, 2);
  }
  return bytes_of({1, address, value});
}

}  // namespace credo::test::fake_usb
