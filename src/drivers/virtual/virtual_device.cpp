#include "drivers/virtual/virtual_device.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "drivers/virtual/oni_property.hpp"

namespace credo {

VirtualDevice::VirtualDevice(VirtualSensor& sensor)
    : opened_{sensor, sensor.plug_state().times_unplugged},
      modes_{VirtualStream(opened_, SensorStream::kDepth).mode(),
             VirtualStream(opened_, SensorStream::kColor).mode()},
      infos_{OniSensorInfo{ONI_SENSOR_DEPTH, 1, &modes_[0]},
             OniSensorInfo{ONI_SENSOR_COLOR, 1, &modes_[1]}} {}

void VirtualDevice::close() {
  for (auto const& stream : streams_) {
    stream->stop();
  }
  if (opened_.sensor.script().reports) {
    std::string const text = opened_.sensor.uri() + ": handed out " +
                             std::to_string(opened_.depth_handed_out) + " depth and " +
                             std::to_string(opened_.color_handed_out) + " colour images; " +
                             std::to_string(opened_.too_late) + " came too late to be\n";
    std::fputs(text.c_str(), stderr);
  }
}

OniStatus VirtualDevice::getSensorInfoList(OniSensorInfo** infos, int* count) {
  *infos = infos_.data();
  *count = static_cast<int>(infos_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* VirtualDevice::createStream(OniSensorType type) {
  if (type != ONI_SENSOR_DEPTH && type != ONI_SENSOR_COLOR) {
    return nullptr;
  }
  streams_.push_back(std::make_unique<VirtualStream>(
      opened_, type == ONI_SENSOR_DEPTH ? SensorStream::kDepth : SensorStream::kColor));
  return streams_.back().get();
}

void VirtualDevice::destroyStream(oni::driver::StreamBase* stream) {
  std::erase_if(streams_, [stream](auto const& ours) { return ours.get() == stream; });
}

OniBool VirtualDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  bool const supported =
      mode == ONI_IMAGE_REGISTRATION_OFF ||
      (mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR && opened_.sensor.script().can_register);
  return supported ? TRUE : FALSE;
}

OniBool VirtualDevice::isPropertySupported(int id) {
  switch (id) {
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
    case ONI_DEVICE_PROPERTY_DRIVER_VERSION:
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER:
      return TRUE;
    default:
      return FALSE;
  }
}

OniStatus VirtualDevice::getProperty(int id, void* data, int* size) {
  switch (id) {
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
      return answer(opened_.registration.load(), data, size);
    case ONI_DEVICE_PROPERTY_DRIVER_VERSION:
      return answer(OniVersion{0, 1, 0, 0}, data, size);
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER: {
      std::string const& name = opened_.sensor.script().name;
      if (*size <= static_cast<int>(name.size())) {
        return ONI_STATUS_BAD_PARAMETER;
      }
      *size = static_cast<int>(name.size()) + 1;
      std::copy_n(name.c_str(), *size, static_cast<char*>(data));
      return ONI_STATUS_OK;
    }
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus VirtualDevice::setProperty(int id, void const* data, int size) {
  auto const mode = id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION
                        ? asked_for<OniImageRegistrationMode>(data, size)
                        : std::nullopt;
  if (!mode || isImageRegistrationModeSupported(*mode) == FALSE) {
    return ONI_STATUS_NOT_SUPPORTED;
  }
  opened_.registration = *mode;
  return ONI_STATUS_OK;
}

}  // namespace credo
