#include "support/fake_usb/fake_usb.hpp"

#include <utility>

#include "support/fake_usb/bus.hpp"

namespace credo::test::fake_usb {
namespace {

PacketStream& stream_of(Device& device, Stream stream) {
  return stream == Stream::kDepth ? device.camera->depth() : device.camera->color();
}

}  // namespace

void plug(Kinect kinect) {
  Bus::instance().plug(std::move(kinect));
}

void unplug(std::string const& serial) {
  Bus::instance().unplug(serial);
}

void set_faults(std::string const& serial, Faults const& faults) {
  Bus::instance().with(serial, [&](Device& device) { device.faults = faults; });
}

void stall(std::string const& serial, Stream stream) {
  Bus::instance().with(serial, [&](Device& device) { stream_of(device, stream).stall(); });
}

void lose_packets(std::string const& serial, Stream stream, int packets) {
  Bus::instance().with(serial, [&](Device& device) { stream_of(device, stream).lose(packets); });
}

Usage usage(std::string const& serial) {
  return Bus::instance().usage(serial);
}

}  // namespace credo::test::fake_usb
