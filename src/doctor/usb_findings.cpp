#include <algorithm>
#include <map>
#include <string_view>

#include "doctor/text.hpp"
#include "doctor/usb_bus.hpp"

namespace credo {
namespace {

constexpr double kHighSpeed_mbit_s = 480.0;
/// libfreenect 0.5.3 lends 16 transfers of 16 packets to each stream, of 1760 and 1920 bytes: 0.94
/// MB a Kinect.
constexpr int kUsbfsPerSensor_mb = 1;

std::string name_of(UsbDevice const& device) {
  return device.name + " at port " + device.port;
}

/// The hub that it is plugged into: "1-2" of "1-2.3".
std::string_view hub_of(UsbDevice const& device) {
  return std::string_view(device.port).substr(0, device.port.rfind('.'));
}

void judge_speed(UsbDevice const& device, Section& section) {
  if (device.speed_mbit_s < kHighSpeed_mbit_s) {
    section.error(name_of(device) + ": speed",
                  fixed_text(device.speed_mbit_s, 0) +
                      " Mbit/s: too slow for its images, which take USB 2's high speed (480)",
                  "plug it straight into a USB 2 or USB 3 socket of the computer, without a hub or "
                  "an extension; if it stays slow, try another socket and another cable");
  }
}

void judge_access(UsbDevice const& device, Section& section) {
  std::string const ids = usb_id_text(device.vendor, device.product);
  switch (device.access) {
    case UsbDevice::Access::kOpen:
      return;
    case UsbDevice::Access::kNoNode:
      section.error(name_of(device) + ": right to use it", "there is no " + device.node(),
                    "is this a container? Start it with the bus: docker run --privileged -v "
                    "/dev/bus/usb:/dev/bus/usb ...");
      return;
    case UsbDevice::Access::kRefused:
      section.error(
          name_of(device) + ": right to use it", "you may not read and write " + device.node(),
          R"(echo 'SUBSYSTEM=="usb", ATTR{idVendor}==")" + ids.substr(0, 4) +
              R"(", ATTR{idProduct}==")" + ids.substr(5) +
              R"(", MODE="0666"' | sudo tee -a /etc/udev/rules.d/60-credo.rules && sudo udevadm )"
              "control --reload && sudo udevadm trigger");
      return;
  }
}

void judge_driver(UsbDevice const& device, Section& section) {
  if (device.driver == "usbfs") {
    section.warning(name_of(device) + ": in use", "another program has it open",
                    "find it and end it: fuser -v " + device.node());
  } else if (device.driver == "gspca_kinect") {
    section.error(name_of(device) + ": kernel driver",
                  "gspca_kinect, the kernel's own camera driver, holds it",
                  "sudo modprobe -r gspca_kinect; and for good: echo blacklist gspca_kinect | sudo "
                  "tee /etc/modprobe.d/credo.conf");
  } else if (!device.driver.empty()) {
    section.warning(name_of(device) + ": kernel driver",
                    "the kernel's driver " + device.driver + " holds it",
                    "if it does not open: sudo modprobe -r " + device.driver);
  }
}

void judge_camera(UsbDevice const& device, Section& section) {
  section.ok(name_of(device), usb_id_text(device.vendor, device.product) + ", " +
                                  fixed_text(device.speed_mbit_s, 0) + " Mbit/s, " + device.node() +
                                  (device.serial.empty() ? "" : ", serial " + device.serial));
  judge_speed(device, section);
  judge_access(device, section);
  judge_driver(device, section);
}

/// A Kinect's motor runs on the socket's power, its camera does not.
void judge_motor(UsbDevice const& motor, UsbState const& usb, Section& section) {
  bool const has_camera = std::ranges::any_of(usb.devices, [&](UsbDevice const& other) {
    return other.role == UsbDevice::Role::kCamera && hub_of(other) == hub_of(motor);
  });
  if (!has_camera) {
    section.error(name_of(motor), "a Kinect's motor is there, and its camera is not",
                  "plug in the Kinect's power supply; if it is, unplug the Kinect from USB and "
                  "plug it in again");
  }
}

void judge_several(UsbState const& usb, Section& section) {
  std::map<int, std::vector<std::string>> cameras_by_bus;
  int cameras = 0;
  for (UsbDevice const& device : usb.devices) {
    if (device.role == UsbDevice::Role::kCamera) {
      cameras_by_bus[device.bus].push_back(device.port);
      ++cameras;
    }
  }
  for (auto const& [bus, ports] : cameras_by_bus) {
    if (ports.size() > 1) {
      section.warning("bus " + std::to_string(bus),
                      std::to_string(ports.size()) + " sensors share it (ports " + joined(ports) +
                          "): as far as is known, the images of one alone fit",
                      "plug each into a controller of its own: sockets of another bus in lsusb -t, "
                      "or a further USB card");
    }
  }
  int const needed_mb = kUsbfsPerSensor_mb * cameras;
  if (usb.usbfs_memory_mb && *usb.usbfs_memory_mb != 0 && *usb.usbfs_memory_mb < needed_mb) {
    section.error("memory for transfers",
                  std::to_string(*usb.usbfs_memory_mb) + " MB for " + std::to_string(cameras) +
                      " sensors, which want 1 MB each",
                  "echo 16 | sudo tee /sys/module/usbcore/parameters/usbfs_memory_mb");
  }
}

}  // namespace

std::vector<Finding> usb_findings(UsbState const& usb) {
  Section section("USB");
  if (!usb.known) {
    section.warning("bus", "the kernel tells nothing of USB (/sys/bus/usb/devices)",
                    "is this a container, or a virtual machine? Run credo doctor on the computer "
                    "that the sensor is plugged into");
    return section.take();
  }
  if (usb.devices.empty()) {
    section.warning("bus", "no Kinect, Xtion or PrimeSense sensor is plugged in",
                    "plug one in, a Kinect's power supply, too; lsusb must show 045e:02ae or 1d27");
  }
  bool is_held = false;
  for (UsbDevice const& device : usb.devices) {
    if (device.role == UsbDevice::Role::kCamera) {
      judge_camera(device, section);
    } else if (device.role == UsbDevice::Role::kMotor) {
      judge_motor(device, usb, section);
    }
    is_held = is_held || device.driver == "gspca_kinect";
  }
  if (usb.gspca_kinect_loaded && !is_held) {
    section.warning("kernel driver",
                    "gspca_kinect is loaded, and will take the next Kinect that is plugged in",
                    "sudo modprobe -r gspca_kinect; and for good: echo blacklist gspca_kinect | "
                    "sudo tee /etc/modprobe.d/credo.conf");
  }
  judge_several(usb, section);
  return section.take();
}

}  // namespace credo
