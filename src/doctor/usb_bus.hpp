#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "doctor/finding.hpp"

namespace credo {

/// Of Microsoft: a Kinect's camera, motor and sound device are three devices on a hub within it.
inline constexpr std::uint16_t kKinectVendor = 0x045E;
/// Of PrimeSense, and of Asus' Xtion.
inline constexpr std::uint16_t kPrimeSenseVendor = 0x1D27;

/// A USB device that is a sensor, or a part of one.
struct UsbDevice {
  enum class Role : std::uint8_t { kCamera, kMotor, kAudio };
  /// What this user may do with its device node.
  enum class Access : std::uint8_t { kOpen, kRefused, kNoNode };

  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  Role role = Role::kCamera;
  /// "Kinect camera".
  std::string name;
  /// Where it is plugged in, as the kernel writes it: bus 1, socket 2 of it, socket 3 of the hub
  /// there is 1-2.3.
  std::string port;
  int bus = 0;
  int number = 0;
  /// 480 is USB 2's high speed.
  double speed_mbit_s = 0.0;
  /// May be empty.
  std::string serial;
  /// The kernel's driver that holds it, "usbfs" where a program does; mostly empty.
  std::string driver;
  Access access = Access::kOpen;

  [[nodiscard]] bool is_kinect() const { return vendor == kKinectVendor; }
  /// "/dev/bus/usb/001/005".
  [[nodiscard]] std::string node() const;
};

/// What the kernel says of sensors on USB.
struct UsbState {
  /// False where it says nothing of USB at all.
  bool known = false;
  /// In the order of their ports.
  std::vector<UsbDevice> devices;
  bool gspca_kinect_loaded = false;
  /// What all programs together may lend to USB transfers; 0 = no limit.
  std::optional<int> usbfs_memory_mb;
};

/// Below `root`: sys/bus/usb/devices, sys/module, proc/modules and dev/bus/usb.
UsbState read_usb(std::filesystem::path const& root = "/");

/// What of it keeps sensors from working.
std::vector<Finding> usb_findings(UsbState const& usb);

}  // namespace credo
