#include "support/fake_usb/bus.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace credo::test::fake_usb {
namespace {

constexpr std::uint16_t kMotor = 0x02B0;
constexpr std::uint16_t kSound = 0x02AD;
constexpr unsigned char kDepthEndpoint = 0x82;

PacketStream& stream_of(libusb_transfer const& transfer) {
  Camera& camera = *transfer.dev_handle->device->camera;
  return transfer.endpoint == kDepthEndpoint ? camera.depth() : camera.color();
}

void fill(libusb_transfer& transfer) {
  Pace const& pace = transfer.dev_handle->device->camera->pace();
  unsigned char* buffer = transfer.buffer;
  for (int i = 0; i < transfer.num_iso_packets; ++i) {
    libusb_iso_packet_descriptor& packet = transfer.iso_packet_desc[i];
    Bytes const bytes = stream_of(transfer).next(pace);
    std::memcpy(buffer, bytes.data(), std::min<std::size_t>(bytes.size(), packet.length));
    packet.actual_length = static_cast<unsigned>(bytes.size());
    packet.status = LIBUSB_TRANSFER_COMPLETED;
    buffer += packet.length;
  }
}

}  // namespace

Bus& Bus::instance() {
  // For ever: threads that were given up may still call.
  static Bus& bus = *new Bus;
  return bus;
}

void Bus::plug(Kinect kinect) {
  auto const camera = std::make_shared<Camera>(std::move(kinect));
  std::scoped_lock const lock(mutex_);
  for (std::uint16_t const product : {kMotor, kSound, kCamera}) {
    devices_.push_back(std::make_unique<Device>());
    devices_.back()->camera = camera;
    devices_.back()->product = product;
  }
}

void Bus::unplug(std::string const& serial) {
  std::scoped_lock const lock(mutex_);
  for (auto const& device : devices_) {
    device->plugged = device->plugged && device->camera->serial() != serial;
  }
  changed_.notify_all();
}

std::vector<libusb_device*> Bus::plugged(libusb_context* context) {
  std::scoped_lock const lock(mutex_);
  std::vector<libusb_device*> found;
  for (auto const& device : devices_) {
    if (device->plugged) {
      found.push_back(seen(device.get(), context));
    }
  }
  return found;
}

libusb_device* Bus::seen(Device* device, libusb_context* context) {
  auto const found = std::ranges::find_if(
      seen_, [&](auto const& one) { return one->seen == device && one->context == context; });
  if (found != seen_.end()) {
    return found->get();
  }
  seen_.push_back(std::make_unique<libusb_device>(libusb_device{device, context}));
  return seen_.back().get();
}

Device* Bus::find(std::string const& serial) {
  for (auto device = devices_.rbegin(); device != devices_.rend(); ++device) {
    if ((*device)->product == kCamera && (*device)->camera->serial() == serial) {
      return device->get();
    }
  }
  return nullptr;
}

void Bus::with(std::string const& serial, std::function<void(Device&)> const& what) {
  std::scoped_lock const lock(mutex_);
  if (Device* const device = find(serial)) {
    what(*device);
  }
  changed_.notify_all();
}

Usage Bus::usage(std::string const& serial) {
  std::scoped_lock const lock(mutex_);
  Device const* const device = find(serial);
  if (device == nullptr) {
    return {};
  }
  Usage usage;
  usage.open_handles = static_cast<int>(
      std::ranges::count(handles_, device, [](libusb_device_handle* h) { return h->device; }));
  usage.transfers_in_flight = static_cast<int>(std::ranges::count(
      transfers_, device, [](libusb_transfer* t) { return t->dev_handle->device; }));
  usage.depth_starts = device->camera->depth_starts();
  usage.color_starts = device->camera->color_starts();
  usage.color_flags = device->camera->color_flags();
  usage.misuses = device->misuses;
  return usage;
}

int Bus::open(libusb_device* device, libusb_device_handle** handle) {
  std::scoped_lock const lock(mutex_);
  if (!device->seen->plugged) {
    return LIBUSB_ERROR_NO_DEVICE;
  }
  if (device->seen->faults.open_error != 0) {
    return device->seen->faults.open_error;
  }
  *handle = new libusb_device_handle{device, device->seen, device->context, false};
  handles_.push_back(*handle);
  return 0;
}

void Bus::close(libusb_device_handle* handle) {
  std::scoped_lock const lock(mutex_);
  auto const uses = [&](libusb_transfer* t) { return t->dev_handle == handle; };
  handle->device->misuses += static_cast<int>(std::ranges::count_if(transfers_, uses));
  std::erase_if(transfers_, uses);
  handle->device->claimed = handle->device->claimed && !handle->claimed;
  std::erase(handles_, handle);
  delete handle;
}

int Bus::claim(libusb_device_handle* handle) {
  std::scoped_lock const lock(mutex_);
  Device& device = *handle->device;
  if (!device.plugged) {
    return LIBUSB_ERROR_NO_DEVICE;
  }
  if (device.faults.claim_error != 0 || (device.claimed && !handle->claimed)) {
    return device.claimed ? LIBUSB_ERROR_BUSY : device.faults.claim_error;
  }
  device.claimed = true;
  handle->claimed = true;
  return 0;
}

void Bus::release(libusb_device_handle* handle) {
  std::scoped_lock const lock(mutex_);
  handle->device->claimed = handle->device->claimed && !handle->claimed;
  handle->claimed = false;
}

int Bus::control(libusb_device_handle* handle, bool reads, unsigned char* data, std::size_t size) {
  std::scoped_lock const lock(mutex_);
  Device& device = *handle->device;
  if (!device.plugged) {
    return LIBUSB_ERROR_NO_DEVICE;
  }
  if (!reads) {
    device.camera->command(Bytes(data, data + size), Clock::now());
    changed_.notify_all();
    return static_cast<int>(size);
  }
  if (device.faults.silent_replies) {
    return 0;
  }
  Bytes const& reply = device.camera->reply();
  std::size_t const count = std::min(size, reply.size());
  std::copy_n(reply.begin(), count, data);
  return static_cast<int>(count);
}

int Bus::submit(libusb_transfer* transfer) {
  std::scoped_lock const lock(mutex_);
  Device const& device = *transfer->dev_handle->device;
  if (!device.plugged) {
    return LIBUSB_ERROR_NO_DEVICE;
  }
  if (device.faults.submit_error != 0) {
    return device.faults.submit_error;
  }
  transfers_.push_back(transfer);
  return 0;
}

bool Bus::in_flight(libusb_transfer* transfer) const {
  return std::ranges::find(transfers_, transfer) != transfers_.end();
}

int Bus::cancel(libusb_transfer* transfer) {
  std::scoped_lock const lock(mutex_);
  if (!in_flight(transfer)) {
    return LIBUSB_ERROR_NOT_FOUND;
  }
  cancelled_.push_back(transfer);
  changed_.notify_all();
  return 0;
}

void Bus::free(libusb_transfer* transfer) {
  std::scoped_lock const lock(mutex_);
  if (in_flight(transfer)) {
    ++transfer->dev_handle->device->misuses;
    std::erase(transfers_, transfer);
  }
}

bool Bus::has_ended(libusb_transfer* transfer, Clock::time_point now) {
  Device& device = *transfer->dev_handle->device;
  if (std::erase(cancelled_, transfer) > 0) {
    transfer->status = LIBUSB_TRANSFER_CANCELLED;
  } else if (!device.plugged) {
    transfer->status = LIBUSB_TRANSFER_NO_DEVICE;
  } else if (stream_of(*transfer).due(device.camera->pace(), transfer->num_iso_packets) <= now) {
    transfer->status = LIBUSB_TRANSFER_COMPLETED;
    fill(*transfer);
  } else {
    return false;
  }
  return true;
}

std::vector<libusb_transfer*> Bus::take_ended(libusb_context* context, Clock::time_point now) {
  std::vector<libusb_transfer*> ended;
  std::erase_if(transfers_, [&](libusb_transfer* transfer) {
    bool const one = transfer->dev_handle->context == context && has_ended(transfer, now);
    if (one) {
      ended.push_back(transfer);
    }
    return one;
  });
  return ended;
}

Clock::time_point Bus::next_due(libusb_context* context) {
  Clock::time_point first = Clock::time_point::max();
  for (libusb_transfer const* transfer : transfers_) {
    if (transfer->dev_handle->context == context) {
      Pace const& pace = transfer->dev_handle->device->camera->pace();
      first = std::min(first, stream_of(*transfer).due(pace, transfer->num_iso_packets));
    }
  }
  return first;
}

void Bus::handle_events(libusb_context* context, Clock::duration patience) {
  auto const deadline = Clock::now() + patience;
  std::vector<libusb_transfer*> ended;
  {
    std::unique_lock lock(mutex_);
    for (ended = take_ended(context, Clock::now()); ended.empty() && Clock::now() < deadline;
         ended = take_ended(context, Clock::now())) {
      changed_.wait_until(lock, std::min(deadline, next_due(context)));
    }
  }
  for (libusb_transfer* transfer : ended) {
    transfer->callback(transfer);
  }
}

}  // namespace credo::test::fake_usb
