#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace credo {

// All of these want an OpenniLibrary.

/// The URIs of the sensors that are plugged in now, of that kind where one is given.
std::vector<std::string> sensor_uris(std::optional<std::uint32_t> kind = std::nullopt);

/// Tells kinds of sensors apart: USB vendor in the upper half, product in the lower. None where no
/// such sensor is there.
std::optional<std::uint32_t> sensor_kind(std::string const& uri);

/// A way in which a stream can run.
struct SensorMode {
  int width_px = 0;
  int height_px = 0;
  int rate_hz = 0;
  /// As OpenNI2 calls it: "1 mm", "RGB888".
  std::string format;
};

/// A sensor that is plugged in.
struct SensorInfo {
  std::string uri;
  std::string vendor;
  std::string name;
  std::uint16_t usb_vendor = 0;
  std::uint16_t usb_product = 0;
  std::vector<SensorMode> depth_modes;
  std::vector<SensorMode> color_modes;
  /// Whether it can bring depth into the colour camera's image.
  bool registers = false;
  /// Why it cannot be opened, and nothing but its name is known; else empty.
  std::string trouble;
};

/// Opens each sensor for a moment.
std::vector<SensorInfo> list_sensors();

}  // namespace credo
