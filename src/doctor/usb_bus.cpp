#include "doctor/usb_bus.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string_view>

#include "doctor/text.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

struct KnownDevice {
  std::uint16_t vendor;
  std::uint16_t product;
  UsbDevice::Role role;
  char const* name;
};

/// As in libfreenect 0.5.3 and the udev rules of Debian's libopenni2-0.
constexpr std::array kKnown = {
    KnownDevice{kKinectVendor, 0x02AE, UsbDevice::Role::kCamera, "Kinect camera"},
    KnownDevice{kKinectVendor, 0x02BF, UsbDevice::Role::kCamera, "Kinect for Windows camera"},
    KnownDevice{kKinectVendor, 0x02B0, UsbDevice::Role::kMotor, "Kinect motor"},
    KnownDevice{kKinectVendor, 0x02C2, UsbDevice::Role::kMotor, "Kinect for Windows motor"},
    KnownDevice{kKinectVendor, 0x02AD, UsbDevice::Role::kAudio, "Kinect sound"},
    KnownDevice{kKinectVendor, 0x02BB, UsbDevice::Role::kAudio, "Kinect sound"},
    KnownDevice{kKinectVendor, 0x02BE, UsbDevice::Role::kAudio, "Kinect for Windows sound"},
    KnownDevice{kKinectVendor, 0x02C3, UsbDevice::Role::kAudio, "Kinect for Windows sound"},
    KnownDevice{kPrimeSenseVendor, 0x0600, UsbDevice::Role::kCamera, "Xtion Pro"},
    KnownDevice{kPrimeSenseVendor, 0x0601, UsbDevice::Role::kCamera, "Xtion Pro Live"},
    KnownDevice{kPrimeSenseVendor, 0x0609, UsbDevice::Role::kCamera, "PrimeSense Carmine"},
};

std::optional<KnownDevice> known_device(std::uint16_t vendor, std::uint16_t product) {
  auto const* const found = std::ranges::find_if(kKnown, [&](KnownDevice const& known) {
    return known.vendor == vendor && known.product == product;
  });
  if (found != kKnown.end()) {
    return *found;
  }
  if (vendor == kPrimeSenseVendor) {
    return KnownDevice{vendor, product, UsbDevice::Role::kCamera, "PrimeSense sensor"};
  }
  return std::nullopt;
}

std::uint16_t hex_in(fs::path const& path) {
  std::string const text = first_line(path).value_or("0");
  return static_cast<std::uint16_t>(std::strtoul(text.c_str(), nullptr, 16));
}

double number_in(fs::path const& path) {
  return std::strtod(first_line(path).value_or("0").c_str(), nullptr);
}

/// An interface `port:1.0` is held by a driver, not the device itself.
std::string driver_of(fs::path const& devices, std::string const& port) {
  std::error_code error;
  for (auto const& entry : fs::directory_iterator(devices, error)) {
    if (entry.path().filename().string().starts_with(port + ":")) {
      fs::path const driver = fs::read_symlink(entry.path() / "driver", error);
      if (!error) {
        return driver.filename();
      }
    }
  }
  return "";
}

UsbDevice::Access access_to(fs::path const& node) {
  if (::access(node.c_str(), F_OK) != 0) {
    return UsbDevice::Access::kNoNode;
  }
  return ::access(node.c_str(), R_OK | W_OK) == 0 ? UsbDevice::Access::kOpen
                                                  : UsbDevice::Access::kRefused;
}

std::optional<UsbDevice> read_device(fs::path const& root, fs::path const& folder) {
  UsbDevice device;
  device.vendor = hex_in(folder / "idVendor");
  device.product = hex_in(folder / "idProduct");
  auto const known = known_device(device.vendor, device.product);
  if (!known) {
    return std::nullopt;
  }
  device.role = known->role;
  device.name = known->name;
  device.port = folder.filename();
  device.bus = static_cast<int>(number_in(folder / "busnum"));
  device.number = static_cast<int>(number_in(folder / "devnum"));
  device.speed_mbit_s = number_in(folder / "speed");
  device.serial = first_line(folder / "serial").value_or("");
  device.driver = driver_of(folder.parent_path(), device.port);
  device.access = access_to(root / device.node().substr(1));
  return device;
}

bool is_loaded(fs::path const& root, std::string_view module) {
  std::ifstream file(root / "proc/modules");
  for (std::string line; std::getline(file, line);) {
    if (std::string_view(line).substr(0, line.find(' ')) == module) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string UsbDevice::node() const {
  std::ostringstream text;
  text << "/dev/bus/usb/" << std::setfill('0') << std::setw(3) << bus << '/' << std::setw(3)
       << number;
  return text.str();
}

UsbState read_usb(fs::path const& root) {
  UsbState usb;
  std::error_code error;
  fs::path const devices = root / "sys/bus/usb/devices";
  usb.known = fs::is_directory(devices, error);
  for (auto const& entry : fs::directory_iterator(devices, error)) {
    if (auto device = read_device(root, entry.path())) {
      usb.devices.push_back(std::move(*device));
    }
  }
  std::ranges::sort(usb.devices, {}, &UsbDevice::port);
  usb.gspca_kinect_loaded = is_loaded(root, "gspca_kinect");
  if (auto const limit = first_line(root / "sys/module/usbcore/parameters/usbfs_memory_mb")) {
    usb.usbfs_memory_mb = static_cast<int>(std::strtol(limit->c_str(), nullptr, 10));
  }
  return usb;
}

}  // namespace credo
