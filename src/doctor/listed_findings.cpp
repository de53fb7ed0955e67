#include "doctor/listed_findings.hpp"

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <set>

#include "doctor/text.hpp"

namespace credo {
namespace {

/// "640x480 at 30 Hz (1 mm), ...", each once.
std::string modes_text(std::vector<SensorMode> const& modes) {
  std::set<std::string> known;
  std::vector<std::string> texts;
  for (SensorMode const& mode : modes) {
    std::string one = std::to_string(mode.width_px) + "x" + std::to_string(mode.height_px) +
                      " at " + std::to_string(mode.rate_hz) + " Hz (" + mode.format + ")";
    if (known.insert(one).second) {
      texts.push_back(std::move(one));
    }
  }
  return texts.empty() ? "none" : joined(texts);
}

void judge_listed(SensorInfo const& sensor, Section& section) {
  if (!sensor.trouble.empty()) {
    section.error(sensor.uri, "cannot be opened: " + sensor.trouble,
                  "end other programs that use it (credo run, NiViewer2), or unplug it and plug it "
                  "in again");
  } else if (sensor.depth_modes.empty()) {
    section.error(sensor.uri, sensor.vendor + " " + sensor.name + " has no depth",
                  "name another sensor: credo doctor --source openni:URI");
  } else {
    section.ok(sensor.uri, sensor.vendor + " " + sensor.name + ": depth " +
                               modes_text(sensor.depth_modes) + "; colour " +
                               modes_text(sensor.color_modes));
  }
}

/// Of one vendor's cameras on the bus, of which not all are listed.
void judge_missing(std::vector<UsbDevice> const& cameras, std::size_t listed,
                   OpenniInstall const& install, Section& section) {
  std::string const name = cameras.front().name;
  std::string const found = std::to_string(cameras.size()) + " on the bus, " +
                            std::to_string(listed) + " listed by OpenNI2: ";
  auto const any = [&](auto const& is) { return std::ranges::any_of(cameras, is); };
  if (cameras.front().is_kinect() && !install.has_kinect_driver()) {
    section.error(name, found + "there is no driver for it", "see OpenNI2: Kinect driver");
  } else if (any([](UsbDevice const& c) { return c.access != UsbDevice::Access::kOpen; })) {
    section.error(name, found + "you may not use it", "see USB: right to use it");
  } else if (any([](UsbDevice const& c) { return c.driver == "gspca_kinect"; })) {
    section.error(name, found + "the kernel's camera driver holds it", "see USB: kernel driver");
  } else if (any([](UsbDevice const& c) { return c.driver == "usbfs"; })) {
    section.error(name, found + "another program has it open", "see USB: in use");
  } else {
    section.error(name, found + "its driver could not open it",
                  "unplug it, plug it in again, and wait five seconds; if it stays away: is it a "
                  "Kinect 1414 (on the label under its foot)? docs/live.md says what others need");
  }
}

void judge_bus(std::vector<SensorInfo> const& listed, UsbState const& usb,
               OpenniInstall const& install, Section& section) {
  for (std::uint16_t const vendor : {kKinectVendor, kPrimeSenseVendor}) {
    std::vector<UsbDevice> cameras;
    std::ranges::copy_if(usb.devices, std::back_inserter(cameras), [&](UsbDevice const& device) {
      return device.vendor == vendor && device.role == UsbDevice::Role::kCamera;
    });
    auto const of_vendor =
        static_cast<std::size_t>(std::ranges::count(listed, vendor, &SensorInfo::usb_vendor));
    if (cameras.size() > of_vendor) {
      judge_missing(cameras, of_vendor, install, section);
    }
  }
}

}  // namespace

std::vector<Finding> listed_findings(std::vector<SensorInfo> const& listed, UsbState const& usb,
                                     OpenniInstall const& install) {
  Section section("sensors");
  for (SensorInfo const& sensor : listed) {
    judge_listed(sensor, section);
  }
  judge_bus(listed, usb, install, section);
  if (listed.empty()) {
    section.error("list", "OpenNI2 lists no sensor",
                  "plug one in and see what USB says above; without one, a virtual sensor: "
                  "docs/virtual-sensor.md");
  }
  return section.take();
}

}  // namespace credo
