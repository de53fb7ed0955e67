// The functions of libusb-1.0 that libfreenect (and what else a test loads) calls, over the bus.
#include <libusb.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include "support/fake_usb/bus.hpp"

using credo::test::fake_usb::Bus;

namespace {

constexpr std::uint8_t kSerialString = 3;

Bus& bus() {
  return Bus::instance();
}

}  // namespace

int libusb_init(libusb_context** context) {
  auto* const made = new libusb_context;
  if (context != nullptr) {
    *context = made;
  }
  return 0;
}
void libusb_exit(libusb_context* context) {
  delete context;
}
int libusb_set_option(libusb_context* /*context*/, libusb_option /*option*/, ...) {
  return 0;
}

char const* libusb_error_name(int code) {
  switch (code) {
    case LIBUSB_ERROR_ACCESS:
      return "LIBUSB_ERROR_ACCESS";
    case LIBUSB_ERROR_NO_DEVICE:
      return "LIBUSB_ERROR_NO_DEVICE";
    case LIBUSB_ERROR_BUSY:
      return "LIBUSB_ERROR_BUSY";
    default:
      return "LIBUSB_ERROR_OTHER";
  }
}

ssize_t libusb_get_device_list(libusb_context* context, libusb_device*** list) {
  auto const devices = bus().plugged(context);
  *list = static_cast<libusb_device**>(std::calloc(devices.size() + 1, sizeof(libusb_device*)));
  std::copy(devices.begin(), devices.end(), *list);
  return static_cast<ssize_t>(devices.size());
}
void libusb_free_device_list(libusb_device** list, int /*unref*/) {
  std::free(list);
}

int libusb_get_device_descriptor(libusb_device* device, libusb_device_descriptor* descriptor) {
  *descriptor = {};
  descriptor->idVendor = 0x045E;
  descriptor->idProduct = device->seen->product;
  descriptor->bcdDevice = 267;  // model 1414
  descriptor->iSerialNumber = kSerialString;
  return 0;
}
int libusb_get_active_config_descriptor(libusb_device* /*device*/,
                                        libusb_config_descriptor** config) {
  *config = new libusb_config_descriptor{};
  (*config)->bNumInterfaces = 2;
  return 0;
}
int libusb_get_config_descriptor(libusb_device* device, std::uint8_t /*index*/,
                                 libusb_config_descriptor** config) {
  return libusb_get_active_config_descriptor(device, config);
}
void libusb_free_config_descriptor(libusb_config_descriptor* config) {
  delete config;
}
std::uint8_t libusb_get_bus_number(libusb_device* /*device*/) {
  return 1;
}
std::uint8_t libusb_get_device_address(libusb_device* /*device*/) {
  return 1;
}
libusb_device* libusb_get_parent(libusb_device* /*device*/) {
  return nullptr;
}
int libusb_get_max_iso_packet_size(libusb_device* /*device*/, unsigned char endpoint) {
  return endpoint == 0x82 ? 1760 : 1920;
}

int libusb_open(libusb_device* device, libusb_device_handle** handle) {
  return bus().open(device, handle);
}
void libusb_close(libusb_device_handle* handle) {
  bus().close(handle);
}
libusb_device* libusb_get_device(libusb_device_handle* handle) {
  return handle->opened;
}
int libusb_reset_device(libusb_device_handle* /*handle*/) {
  return 0;
}

int libusb_get_string_descriptor_ascii(libusb_device_handle* handle, std::uint8_t index,
                                       unsigned char* data, int length) {
  if (!handle->device->plugged || index != kSerialString) {
    return LIBUSB_ERROR_NO_DEVICE;
  }
  std::string const& serial = handle->device->camera->serial();
  std::memset(data, 0, static_cast<std::size_t>(length));
  std::memcpy(data, serial.data(), std::min(serial.size(), static_cast<std::size_t>(length) - 1));
  return static_cast<int>(serial.size());
}

int libusb_kernel_driver_active(libusb_device_handle* /*handle*/, int /*interface*/) {
  return 0;
}
int libusb_attach_kernel_driver(libusb_device_handle* /*handle*/, int /*interface*/) {
  return 0;
}
int libusb_detach_kernel_driver(libusb_device_handle* /*handle*/, int /*interface*/) {
  return 0;
}
int libusb_claim_interface(libusb_device_handle* handle, int /*interface*/) {
  return bus().claim(handle);
}
int libusb_release_interface(libusb_device_handle* handle, int /*interface*/) {
  bus().release(handle);
  return 0;
}
int libusb_set_interface_alt_setting(libusb_device_handle* /*handle*/, int /*interface*/,
                                     int /*setting*/) {
  return 0;
}

int libusb_control_transfer(libusb_device_handle* handle, std::uint8_t type,
                            std::uint8_t /*request*/, std::uint16_t /*value*/,
                            std::uint16_t /*index*/, unsigned char* data, std::uint16_t length,
                            unsigned /*timeout*/) {
  int const count = bus().control(handle, (type & LIBUSB_ENDPOINT_IN) != 0, data, length);
  if (count == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // as the wire takes
  }
  return count;
}
int libusb_bulk_transfer(libusb_device_handle* /*handle*/, unsigned char /*endpoint*/,
                         unsigned char* /*data*/, int /*length*/, int* transferred,
                         unsigned /*timeout*/) {
  *transferred = 0;
  return LIBUSB_ERROR_NOT_SUPPORTED;
}

libusb_transfer* libusb_alloc_transfer(int packets) {
  std::size_t const bytes = sizeof(libusb_transfer) + static_cast<std::size_t>(packets) *
                                                          sizeof(libusb_iso_packet_descriptor);
  return static_cast<libusb_transfer*>(std::calloc(1, bytes));
}
void libusb_free_transfer(libusb_transfer* transfer) {
  bus().free(transfer);
  std::free(transfer);
}
int libusb_submit_transfer(libusb_transfer* transfer) {
  return bus().submit(transfer);
}
int libusb_cancel_transfer(libusb_transfer* transfer) {
  return bus().cancel(transfer);
}

int libusb_handle_events(libusb_context* context) {
  bus().handle_events(context, std::chrono::seconds(60));
  return 0;
}
int libusb_handle_events_timeout(libusb_context* context, timeval* patience) {
  bus().handle_events(context, std::chrono::seconds(patience->tv_sec) +
                                   std::chrono::microseconds(patience->tv_usec));
  return 0;
}
