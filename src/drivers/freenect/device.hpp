#pragma once

#include <array>
#include <atomic>
#include <string>

#include "drivers/freenect/kinect.hpp"
#include "drivers/freenect/stream.hpp"
#include "drivers/openni_driver_api.hpp"

namespace credo::freenect {

/// An open Kinect as OpenNI2 wants it: two sensors, and registration of depth to colour.
class KinectDevice : public oni::driver::DeviceBase {
public:
  /// Throws KinectError.
  KinectDevice(std::string const& serial, oni::driver::DriverServices& services);
  KinectDevice(KinectDevice const&) = delete;
  KinectDevice& operator=(KinectDevice const&) = delete;
  KinectDevice(KinectDevice&&) = delete;
  KinectDevice& operator=(KinectDevice&&) = delete;
  ~KinectDevice() override;

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniBool isPropertySupported(int id) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, void const* data, int size) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

  [[nodiscard]] std::string const& serial() const { return serial_; }
  Kinect& kinect() { return kinect_; }
  /// Whether OpenNI still has a stream of it.
  [[nodiscard]] bool has_streams() const { return depth_ != nullptr || color_ != nullptr; }

private:
  KinectSinks sinks();

  std::string serial_;
  oni::driver::DriverServices& services_;
  std::array<OniVideoMode, 2> modes_;
  std::array<OniSensorInfo, 2> sensors_;
  std::atomic<bool> registered_ = false;
  // Set while OpenNI has one; they are stopped before they go.
  std::atomic<DepthStream*> depth_ = nullptr;
  std::atomic<ColorStream*> color_ = nullptr;
  // Last: its thread knows all the others.
  Kinect kinect_;
};

}  // namespace credo::freenect
