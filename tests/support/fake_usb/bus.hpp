#pragma once

#include <libusb.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "support/fake_usb/camera.hpp"

namespace credo::test::fake_usb {

/// A device of a Kinect: its camera, its motor or its sound. Known for ever, plugged in or not.
struct Device {
  std::shared_ptr<Camera> camera;
  std::uint16_t product = 0;
  bool plugged = true;
  bool claimed = false;
  Faults faults;
  int misuses = 0;
};

}  // namespace credo::test::fake_usb

struct libusb_context {};

/// A device as one context sees it.
struct libusb_device {
  credo::test::fake_usb::Device* seen = nullptr;
  libusb_context* context = nullptr;
};

struct libusb_device_handle {
  libusb_device* opened = nullptr;
  credo::test::fake_usb::Device* device = nullptr;
  libusb_context* context = nullptr;
  bool claimed = false;
};

namespace credo::test::fake_usb {

/// All that is plugged in, and the transfers under way. Functions may be called from any thread.
class Bus {
public:
  static constexpr std::uint16_t kCamera = 0x02AE;

  static Bus& instance();

  void plug(Kinect kinect);
  void unplug(std::string const& serial);
  std::vector<libusb_device*> plugged(libusb_context* context);
  /// With the camera of that serial, the one plugged in last, and the lock held.
  void with(std::string const& serial, std::function<void(Device&)> const& what);
  Usage usage(std::string const& serial);

  int open(libusb_device* device, libusb_device_handle** handle);
  void close(libusb_device_handle* handle);
  int claim(libusb_device_handle* handle);
  void release(libusb_device_handle* handle);
  int control(libusb_device_handle* handle, bool reads, unsigned char* data, std::size_t size);

  int submit(libusb_transfer* transfer);
  int cancel(libusb_transfer* transfer);
  void free(libusb_transfer* transfer);
  /// Ends transfers of that context that are due, at least one where one is due in time.
  void handle_events(libusb_context* context, Clock::duration patience);

private:
  Device* find(std::string const& serial);
  libusb_device* seen(Device* device, libusb_context* context);
  bool in_flight(libusb_transfer* transfer) const;
  /// Takes the transfers of that context that have ended by `now` out of those under way.
  std::vector<libusb_transfer*> take_ended(libusb_context* context, Clock::time_point now);
  bool has_ended(libusb_transfer* transfer, Clock::time_point now);
  Clock::time_point next_due(libusb_context* context);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::vector<std::unique_ptr<libusb_device>> seen_;
  std::vector<libusb_device_handle*> handles_;
  /// In the order of their submission.
  std::deque<libusb_transfer*> transfers_;
  std::vector<libusb_transfer*> cancelled_;
};

}  // namespace credo::test::fake_usb
