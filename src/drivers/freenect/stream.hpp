#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/freenect/depth_cleaning.hpp"
#include "drivers/freenect/kinect.hpp"
#include "drivers/openni_driver_api.hpp"

namespace credo::freenect {

/// A stream as OpenNI2 wants it: 640 x 480 at 30 Hz, not cropped, mirrored on request.
class KinectStream : public oni::driver::StreamBase {
public:
  KinectStream(Kinect& kinect, oni::driver::DriverServices& services, StreamKind kind)
      : kinect_(kinect), services_(services), kind_(kind) {}

  OniStatus start() override;
  void stop() override;
  OniBool isPropertySupported(int id) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, void const* data, int size) override;

  [[nodiscard]] static OniSensorType sensor_of(StreamKind kind);
  /// The one mode that there is.
  [[nodiscard]] static OniVideoMode mode_of(StreamKind kind);

protected:
  /// The camera's focal length, of which OpenNI makes a field of view.
  [[nodiscard]] virtual double focal_length_px() const = 0;
  [[nodiscard]] virtual int max_value() const = 0;

  Kinect& kinect() { return kinect_; }
  oni::driver::DriverServices& services() { return services_; }
  [[nodiscard]] bool mirrored() const { return mirrored_; }
  /// A frame of OpenNI's to be filled; nullptr where it has none.
  OniFrame* new_frame(std::uint64_t stamp_us);
  /// Hands it over.
  void raise(OniFrame* frame);

private:
  Kinect& kinect_;
  oni::driver::DriverServices& services_;
  StreamKind kind_;
  std::atomic<bool> mirrored_ = false;
  int frames_ = 0;
};

class DepthStream : public KinectStream {
public:
  DepthStream(Kinect& kinect, oni::driver::DriverServices& services,
              std::atomic<bool> const& registered)
      : KinectStream(kinect, services, StreamKind::kDepth), registered_(registered) {}

  void deliver(std::span<std::uint16_t const> depths_mm, DepthCleaner const& cleaner,
               std::uint64_t stamp_us);

protected:
  [[nodiscard]] double focal_length_px() const override;
  [[nodiscard]] int max_value() const override { return kFarthest_mm - 1; }

private:
  std::atomic<bool> const& registered_;
};

/// With switches for automatic exposure and white balance. The Kinect does not tell how they are:
/// read, they are as they were last set, on at first.
class ColorStream : public KinectStream {
public:
  ColorStream(Kinect& kinect, oni::driver::DriverServices& services)
      : KinectStream(kinect, services, StreamKind::kColor) {}

  void deliver(std::span<std::uint8_t const> rgb, std::uint64_t stamp_us);

  OniBool isPropertySupported(int id) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, void const* data, int size) override;

protected:
  [[nodiscard]] double focal_length_px() const override;
  [[nodiscard]] int max_value() const override { return 255; }

private:
  std::atomic<bool> exposure_ = true;
  std::atomic<bool> white_balance_ = true;
};

}  // namespace credo::freenect
