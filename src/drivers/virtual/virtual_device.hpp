#pragma once

#include <array>
#include <memory>
#include <vector>

#include "drivers/openni_driver_api.hpp"
#include "drivers/virtual/virtual_stream.hpp"

namespace credo {

/// An open sensor: one depth and one colour stream. It owns its streams, and must be kept until the
/// driver ends: OpenNI2 may still name streams of a device that it has closed.
class VirtualDevice final : public oni::driver::DeviceBase {
public:
  /// The sensor must be loaded, and outlive it.
  explicit VirtualDevice(VirtualSensor& sensor);
  VirtualDevice(VirtualDevice const&) = delete;
  VirtualDevice& operator=(VirtualDevice const&) = delete;
  VirtualDevice(VirtualDevice&&) = delete;
  VirtualDevice& operator=(VirtualDevice&&) = delete;
  ~VirtualDevice() override = default;

  /// Ends its streams for good, and reports where the script says so.
  void close();

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType type) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus setProperty(int id, void const* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

private:
  OpenedSensor opened_;
  std::array<OniVideoMode, 2> modes_;
  std::array<OniSensorInfo, 2> infos_;
  std::vector<std::unique_ptr<VirtualStream>> streams_;
};

}  // namespace credo
