#include "openni/sensor_list.hpp"

#include <OpenNI.h>

#include <cstddef>

#include "openni/openni_error.hpp"

namespace credo {
namespace {

std::uint32_t kind_of(openni::DeviceInfo const& info) {
  return (std::uint32_t{info.getUsbVendorId()} << 16U) | info.getUsbProductId();
}

char const* name_of(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
      return "1 mm";
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return "0.1 mm";
    case openni::PIXEL_FORMAT_RGB888:
      return "RGB888";
    case openni::PIXEL_FORMAT_YUV422:
      return "YUV422";
    case openni::PIXEL_FORMAT_YUYV:
      return "YUYV";
    case openni::PIXEL_FORMAT_GRAY8:
      return "8-bit grey";
    case openni::PIXEL_FORMAT_GRAY16:
      return "16-bit grey";
    case openni::PIXEL_FORMAT_JPEG:
      return "JPEG";
    default:
      return "other";
  }
}

std::vector<SensorMode> modes_of(openni::SensorInfo const* info) {
  std::vector<SensorMode> modes;
  if (info != nullptr) {
    auto const& all = info->getSupportedVideoModes();
    for (int i = 0; i < all.getSize(); ++i) {
      modes.push_back({all[i].getResolutionX(), all[i].getResolutionY(), all[i].getFps(),
                       name_of(all[i].getPixelFormat())});
    }
  }
  return modes;
}

SensorInfo info_of(openni::DeviceInfo const& found) {
  SensorInfo info;
  info.uri = found.getUri();
  info.vendor = found.getVendor();
  info.name = found.getName();
  info.usb_vendor = found.getUsbVendorId();
  info.usb_product = found.getUsbProductId();
  openni::Device device;
  if (device.open(info.uri.c_str()) != openni::STATUS_OK) {
    info.trouble = openni_error();
    return info;
  }
  info.depth_modes = modes_of(device.getSensorInfo(openni::SENSOR_DEPTH));
  info.color_modes = modes_of(device.getSensorInfo(openni::SENSOR_COLOR));
  info.registers =
      device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  device.close();
  return info;
}

}  // namespace

std::vector<std::string> sensor_uris(std::optional<std::uint32_t> kind) {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<std::string> uris;
  for (int i = 0; i < infos.getSize(); ++i) {
    if (!kind || kind_of(infos[i]) == *kind) {
      uris.emplace_back(infos[i].getUri());
    }
  }
  return uris;
}

std::optional<std::uint32_t> sensor_kind(std::string const& uri) {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  for (int i = 0; i < infos.getSize(); ++i) {
    if (uri == infos[i].getUri()) {
      return kind_of(infos[i]);
    }
  }
  return std::nullopt;
}

std::vector<SensorInfo> list_sensors() {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<SensorInfo> sensors;
  sensors.reserve(static_cast<std::size_t>(infos.getSize()));
  for (int i = 0; i < infos.getSize(); ++i) {
    sensors.push_back(info_of(infos[i]));
  }
  return sensors;
}

}  // namespace credo
