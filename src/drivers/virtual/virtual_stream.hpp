#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <thread>

#include "drivers/openni_driver_api.hpp"
#include "drivers/virtual/image_view.hpp"
#include "drivers/virtual/virtual_sensor.hpp"

namespace credo {

/// What is set of a colour camera; nothing that shows in its images.
struct CameraSettings {
  OniBool auto_white_balance = TRUE;
  OniBool auto_exposure = TRUE;
  int exposure = 100;
  int gain = 100;
};

/// What a device's streams must know of it.
struct OpenedSensor {
  VirtualSensor& sensor;
  /// Once it has been unplugged more often than that, the device is dead.
  int times_unplugged = 0;
  std::atomic<OniImageRegistrationMode> registration = ONI_IMAGE_REGISTRATION_OFF;

  /// Of what is set from outside while streams run: here and in them.
  std::mutex mutex{};
  CameraSettings camera{};

  // For the report.
  std::atomic<std::int64_t> depth_handed_out = 0;
  std::atomic<std::int64_t> color_handed_out = 0;
  std::atomic<std::int64_t> too_late = 0;
};

/// One stream of an open device: hands out at each tick, from a thread of its own, what the
/// schedule says. A tick that comes more than a frame's time too late is passed over, and counted.
class VirtualStream final : public oni::driver::StreamBase {
public:
  VirtualStream(OpenedSensor& device, SensorStream kind);
  VirtualStream(VirtualStream const&) = delete;
  VirtualStream& operator=(VirtualStream const&) = delete;
  VirtualStream(VirtualStream&&) = delete;
  VirtualStream& operator=(VirtualStream&&) = delete;
  ~VirtualStream() override = default;

  OniStatus start() override;
  void stop() override;
  OniStatus setProperty(int id, void const* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  int getRequiredFrameSize() override;

  /// The only one.
  [[nodiscard]] OniVideoMode mode() const;

private:
  void run(std::stop_token const& stop);
  void hand_out(std::int64_t tick, std::stop_token const& stop, std::int64_t started_ns);
  void fill(OniFrame& frame, SensorImages const& images, ScheduledImage const& scheduled);
  [[nodiscard]] int pixel_bytes() const;
  [[nodiscard]] ImageView view() const;
  [[nodiscard]] float field_of_view_rad(int id) const;
  OniStatus set_cropping(OniCropping const& cropping);
  /// Where a camera's setting is kept; null where `id` is none, or this is depth.
  [[nodiscard]] int* setting(int id);

  OpenedSensor& device_;
  SensorStream kind_;

  // Behind the device's mutex.
  OniCropping cropping_{};
  OniBool mirrored_ = FALSE;

  std::jthread thread_;
};

}  // namespace credo
